// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "commands.h"
#include "hooke/io/report.h"
#include "hooke/io/snapshot.h"
#include "hooke/run/numbers.h"
#include "hooke/run/open_simulation.h"
#include "hooke/run/start_checks.h"
#include "log.h"
#include "progress.h"

namespace hooke::cli {
namespace {

// Unexplained momentum, relative: far above rounding, far below any fault.
constexpr double kDriftSingle = 1e-4;
constexpr double kDriftDouble = 1e-10;

double largest_radius(const Scene& scene) {
  double radius = 0;
  for (const Material& material : scene.materials) radius = std::max(radius, material.radius);
  return radius;
}

void check_domain(const Scene& scene, const Measurements& now, std::vector<Finding>& faults) {
  for (int axis = 0; axis < 3; ++axis) {
    const Boundary boundary = scene.domain.boundary[static_cast<std::size_t>(axis)];
    if (now.particles == 0 || boundary == Boundary::open) continue;
    // Walls are springs: a centre may be behind a wall, but by less than a radius.
    const double room = boundary == Boundary::spring ? largest_radius(scene) : 0;
    const double low = component(now.min, axis);
    const double high = component(now.max, axis);
    if (low < component(scene.domain.min, axis) - room || high > component(scene.domain.max, axis) + room) {
      faults.push_back({"escaped", fmt::format("particles at {:.6g} to {:.6g} m along {}, outside the domain's {:.6g} "
                                               "to {:.6g} m",
                                               low, high, "xyz"[axis], component(scene.domain.min, axis),
                                               component(scene.domain.max, axis))});
    }
  }
}

// Faults that make the results of a run worthless: a speed is only worth printing for correct steps.
std::vector<Finding> find_faults(const Simulation& simulation, const io::RunReport& report,
                                 std::uint64_t particles_before, const Ledger& before) {
  std::vector<Finding> faults;
  const Measurements& now = report.measurements;
  const Scene& scene = simulation.scene();
  for (const double figure : {now.kinetic_energy, now.potential_energy, now.elastic_energy, now.momentum.x,
                              now.momentum.y, now.momentum.z, now.max_speed, now.max_overlap_ratio}) {
    if (std::isfinite(figure)) continue;
    faults.push_back({"NaN", "energy, momentum, speed or overlap is not a finite number"});
    break;
  }
  check_domain(scene, now, faults);
  const std::uint64_t removed = report.ledger.removed - before.removed;
  const auto changed = [&](std::uint64_t PopulationLedger::* count) {
    return report.ledger.population.*count - before.population.*count;
  };
  const std::uint64_t born = changed(&PopulationLedger::born);
  const std::uint64_t gone = changed(&PopulationLedger::expired) + changed(&PopulationLedger::sunk) + removed;
  const bool has_open_face = std::ranges::find(scene.domain.boundary, Boundary::open) != scene.domain.boundary.end();
  if (report.particles + gone != particles_before + born || (removed > 0 && !has_open_face)) {
    faults.push_back({"escaped", fmt::format("of {} particles and {} born {} are left, and {} are gone, {} of these "
                                             "through open faces",
                                             particles_before, born, report.particles, gone, removed)});
  }
  const double allowed = report.precision == Precision::single_precision ? kDriftSingle : kDriftDouble;
  if (!(report.momentum_drift <= allowed)) {
    faults.push_back(
        {"momentum", fmt::format("drifted by {:.3g} of its scale beyond what gravity, walls and drag gave; "
                                 "rounding explains up to {:.3g}",
                                 report.momentum_drift, allowed)});
  }
  return faults;
}

// Time of the next step's force pass, s.
std::optional<double> time_force_pass(Simulation& simulation) {
  const double before = simulation.stage_times().force;
  if (auto stepped = simulation.step(); !stepped) return {};
  return simulation.stage_times().force - before;
}

// The scene with open, distant faces instead of walls.
Scene without_walls(Scene scene) {
  for (int axis = 0; axis < 3; ++axis) {
    Boundary& boundary = scene.domain.boundary[static_cast<std::size_t>(axis)];
    if (boundary != Boundary::spring) continue;
    boundary = Boundary::open;
    const double length = scene.domain.length(axis);
    component(scene.domain.min, axis) -= length;
    component(scene.domain.max, axis) += length;
  }
  return scene;
}

// The walls' share of the force pass. Walls are fused into it, so a few more passes run from the end of the run, with
// walls and without in turns. Empty where such a pass can't be had or would need much memory.
std::optional<double> share_of_walls(Simulation& simulation, const DeviceArguments& device) {
  constexpr std::size_t kPasses = 9;
  constexpr std::uint64_t kMostParticles = 10'000'000;
  if (simulation.particle_count() > kMostParticles) return {};
  Scene open = without_walls(simulation.scene());
  if (open.domain.boundary == simulation.scene().domain.boundary) return 0;
  std::vector<Finding> ignored;
  auto backend = run::make_backend(device, open, simulation.particle_count(), ignored);
  if (!backend) return {};
  SimulationState state = simulation.state();
  if (!simulation.restore(state)) return {};  // a new list, like the other simulation's
  auto other = Simulation::resume(std::move(open), std::move(state), std::move(*backend));
  if (!other) return {};
  std::array<double, kPasses> with{}, without{};
  for (std::size_t i = 0; i < kPasses; ++i) {
    const auto a = time_force_pass(simulation);
    const auto b = time_force_pass(*other);
    if (!a || !b) return {};
    with[i] = *a;
    without[i] = *b;
  }
  std::ranges::sort(with);
  std::ranges::sort(without);
  return std::clamp(1 - without[kPasses / 2] / with[kPasses / 2], 0.0, 1.0);
}

// Prints how the time of a step divides into stages.
void print_stages(const io::RunReport& report) {
  const auto row = [&](const char* name, double seconds) {
    fmt::print("  {:<22}{:.3f} ms, {:.1f} %\n", name, 1e3 * seconds / static_cast<double>(report.steps),
               100 * seconds / report.seconds);
  };
  const StageTimes& s = report.stages;
  fmt::print("{:<24}{:.3f} ms\n", "a step", 1e3 * report.seconds / static_cast<double>(report.steps));
  row("sort", s.sort);
  row("list", s.list);
  row("motion", s.motion);
  row("force", s.force - report.walls.value_or(0));
  if (report.walls) row("walls", *report.walls);
  if (s.drift > 0) row("drift", s.drift);
  row("rest", report.rest());
}

void print_table(const io::RunReport& report) {
  const auto row = [](const char* name, const std::string& value) { fmt::print("{:<24}{}\n", name, value); };
  row("scene", report.scene);
  row("particles", run::with_commas(report.particles));
  row("steps", fmt::format("{} in {:.3f} s", report.steps, report.seconds));
  row("steps/s", fmt::format("{:.2f}", report.steps_per_second()));
  row("particle-steps/s", fmt::format("{:.2f} M", report.particle_steps_per_second() * 1e-6));
  print_stages(report);
  row("contacts per particle", fmt::format("{:.2f}", report.contacts_per_particle()));
  row("rebuilds", fmt::format("{}", report.neighbours.rebuilds));
  row("list slots per particle", fmt::format("{:.1f}", report.neighbours.slots_per_particle));
  row("bytes per particle", fmt::format("{:.0f}, and {:.0f} MB of program", report.bytes_per_particle(),
                                        static_cast<double>(report.program_bytes) * 1e-6));
  row("device", fmt::format("{} ({}), {}, {} precision", report.device, report.isa,
                            run::ranks_and_threads(report.ranks, report.threads), to_string(report.precision)));
  row("momentum drift", fmt::format("{:.2g}", report.momentum_drift));
  row("state hash", fmt::format("{:016x}", report.state_hash));
}

// Steps, with progress shown if `show`.
Expected<void> advance(Simulation& simulation, std::int64_t steps, bool show) {
  const std::int64_t last = simulation.step_count() + steps;
  Progress progress(simulation.step_count(), last, simulation.scene().time_step, show);
  // Large enough that reading the clock costs nothing, small enough that the line moves.
  const std::int64_t batch = std::max<std::int64_t>(1, steps / 100);
  while (simulation.step_count() < last) {
    if (auto stepped = simulation.step(std::min(batch, last - simulation.step_count())); !stepped) return stepped;
    progress.update(simulation.step_count(), simulation.particle_count());
  }
  return {};
}

}  // namespace

ExitStatus bench_command(const BenchArguments& arguments, const run::LaunchedRanks& ranks) {
  const std::uint64_t program_bytes = io::peak_resident_bytes();
  auto opened = run::open_simulation(arguments.scene, arguments.device, arguments.resume, ranks);
  if (!opened) return report_error(opened.error());
  for (const Finding& warning : opened->warnings) report_warning(warning);
  if (const std::string small = run::small_ranks(*opened); !small.empty()) spdlog::warn(small);
  Simulation& simulation = opened->simulation;
  const std::uint64_t particles_before = simulation.particle_count();
  const Ledger ledger_before = simulation.ledger();

  const bool show = !arguments.json && isatty(STDOUT_FILENO) != 0;
  if (auto warmed = advance(simulation, arguments.warmup, show); !warmed) {
    return report_error(warmed.error(), true);
  }
  const auto rebuilds_before = simulation.neighbour_statistics().rebuilds;
  const StageTimes stages_before = simulation.stage_times();
  (void)simulation.rank_costs();
  const auto start = std::chrono::steady_clock::now();
  if (auto stepped = advance(simulation, arguments.steps, show); !stepped) {
    return report_error(stepped.error(), true);
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  const RankCosts costs = simulation.rank_costs();
  const auto rebuilds = simulation.neighbour_statistics().rebuilds;

  const auto measurements = simulation.measure();
  if (!measurements) return report_error(measurements.error(), true);
  io::RunReport report = io::make_report(simulation, *measurements);
  report.ranks = opened->ranks;
  report.threads = opened->threads;
  report.steps = arguments.steps;
  report.program_bytes = program_bytes;
  report.costs = costs;
  report.seconds = seconds;
  report.neighbours.rebuilds = rebuilds - rebuilds_before;
  report.stages = report.stages - stages_before;
  if (auto faults = find_faults(simulation, report, particles_before, ledger_before); !faults.empty()) {
    return report_error({Error::Kind::run_failed, std::move(faults)}, true);
  }
  if (ranks.size() == 1) {  // of several each has a part of the particles, and another part of the walls
    if (const auto share = share_of_walls(simulation, arguments.device)) report.walls = *share * report.stages.force;
  }
  if (arguments.json) {
    fmt::print("{}", io::to_json(report));
  } else {
    print_table(report);
  }
  return kDone;
}

}  // namespace hooke::cli
