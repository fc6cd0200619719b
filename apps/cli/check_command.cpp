// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "hooke/base/printable.h"
#include "hooke/io/report.h"
#include "hooke/run/numbers.h"
#include "hooke/run/open_simulation.h"
#include "hooke/run/start_checks.h"
#include "hooke/scene/load_scene.h"
#include "log.h"

namespace hooke::cli {
namespace {

void print_step(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const StableStep stable = stable_step(simulation);
  if (std::isinf(stable.seconds)) {
    fmt::print("  step       {:.6g} s; nothing in the scene limits it\n", scene.time_step);
  } else {
    fmt::print("  step       {:.6g} s, {:.3g} of the stable step {:.6g} s, which the {} sets\n", scene.time_step,
               scene.time_step / stable.seconds, stable.seconds, stable.limit);
  }
}

void print_overlaps(const Simulation& simulation, const Measurements& now) {
  std::vector<std::string> sentences = run::overlapped_bodies(simulation);
  if (now.contacts > 0) {
    sentences.insert(
        sentences.begin(),
        fmt::format("{} pairs touch at the start, the deepest overlaps by {:.3g} % of the sum of its radii",
                    run::with_commas(now.contacts), 100 * now.max_pair_overlap_ratio));
  }
  if (sentences.empty()) sentences.emplace_back("none at the start");
  const char* title = "overlaps";
  for (const std::string& sentence : sentences) fmt::print("  {:<8}   {}\n", std::exchange(title, ""), sentence);
}

void print_precision(const Scene& scene) {
  if (scene.precision == Precision::double_precision || scene.materials.empty()) {
    fmt::print("  precision  double\n");
    return;
  }
  const run::FloatSpacing spacing = run::float_spacing(scene);
  fmt::print("  precision  single; positions at the domain's edge are {:.3g} m apart, {:.3g} radii\n", spacing.metres,
             spacing.radii);
}

// What a run needs at the most, with the `program` itself, bytes: its meshes' fields are made before there are many
// particles. Where particles overlap deeply, their list takes more than is counted for a particle: no less than this
// command has taken, which has made the list.
void print_memory(double particles, const scene::FieldMemory& fields, double program, double neighbours) {
  const double running = particles * scene::kBytesPerParticle + fields.kept;
  const double counted = program + std::max(running, fields.most),
               taken = static_cast<double>(io::peak_resident_bytes());
  fmt::print("  memory     about {:.1f} MB", std::max(counted, taken) * 1e-6);
  if (fields.most > 0) {
    fmt::print(", {:.1f} MB of it for the distances from meshes", std::max(fields.kept, fields.most) * 1e-6);
  }
  if (const double list = particles * neighbours * sizeof(std::uint32_t); taken > counted && 4 * list > taken) {
    fmt::print(", most of it for lists of {:.3g} neighbours", neighbours);
  }
  fmt::print("\n");
}

// Expected number of particles from emitters at a time.
double expected_births(const Scene& scene) {
  double expected = 0;
  for (const Emitter& emitter : scene.emitters) {
    expected += expected_population(emitter, static_cast<double>(scene.steps) * scene.time_step);
  }
  return expected;
}

}  // namespace

ExitStatus check_command(const CheckArguments& arguments) {
  const auto program_bytes = static_cast<double>(io::peak_resident_bytes());
  const auto opened = run::open_simulation(arguments.scene, DeviceArguments{}, {});
  if (!opened) return report_error(opened.error());
  const Simulation& simulation = opened->simulation;
  const Scene& scene = simulation.scene();
  const auto now = simulation.measure();
  if (!now) return report_error(now.error());

  for (const Finding& warning : opened->warnings) report_warning(warning);
  const auto particles = simulation.particle_count();
  fmt::print("{}: {}\n", printable(arguments.scene.file.string()), printable(scene.name));
  fmt::print("  particles  {}\n", run::with_commas(particles));
  const double most = static_cast<double>(particles) + expected_births(scene);
  if (!scene.emitters.empty()) {
    fmt::print("  emitters   {}; up to about {} particles\n", scene.emitters.size(),
               run::with_commas(static_cast<std::uint64_t>(most)));
  }
  print_memory(most, opened->fields, program_bytes, simulation.neighbour_statistics().slots_per_particle);
  fmt::print("  duration   {} steps, {:.6g} s\n", scene.steps, static_cast<double>(scene.steps) * scene.time_step);
  print_step(simulation);
  print_overlaps(simulation, *now);
  print_precision(scene);

  for (const Finding& finding : run::deep_starts(simulation)) report_warning(finding);
  if (const std::string unstable = run::unstable_step(simulation); !unstable.empty()) {
    if (arguments.strict) return report_error({Error::Kind::bad_input, {{"", unstable}}});
    spdlog::warn(unstable);
  }
  if (const std::string coarse = run::coarse_positions(simulation); !coarse.empty()) spdlog::warn(coarse);
  return kDone;
}

}  // namespace hooke::cli
