// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Speed of the engine's parts and of whole steps. Every benchmark checks its result: a wrong result has no speed.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hooke/backends/cpu/cpu_backend.h"
#include "hooke/backends/cpu/isa.h"
#include "hooke/base/exact_sum.h"
#include "hooke/base/random.h"
#include "hooke/base/stopwatch.h"
#include "hooke/core/simulation.h"
#include "hooke/core/step.h"
#include "hooke/neighbours/cell_grid.h"

namespace hooke {
namespace {

constexpr double kRadius = 0.2;
constexpr std::size_t kLayers = 20;

Scene pool_scene(std::size_t wide) {
  Scene scene;
  scene.name = "pool";
  scene.materials = {
      {.name = "water", .radius = kRadius, .mass = 1, .contact = {8000, 0.3, 2}, .drag = 0, .color = ""}};
  const double side = 2 * kRadius * static_cast<double>(wide);
  scene.domain.max = {side, 4 * kRadius * kLayers, side};
  return scene;
}

// A pool of `wide` x `wide` x 20 balls that is nearly at rest; made once.
Expected<ParticleSet> settled_pool(std::size_t wide) {
  static std::map<std::size_t, ParticleSet> pools;
  if (const auto known = pools.find(wide); known != pools.end()) return known->second;
  const Scene scene = pool_scene(wide);
  ParticleSet p;
  p.resize(wide * wide * kLayers);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto u = uniform4(1, i, 0);
    const auto at = [](std::size_t index, double random) {
      return kRadius * (1 + 2 * static_cast<double>(index) + 0.2 * (random - 0.5));
    };
    p.id[i] = i + 1;
    p.position[i] = {std::min(at(i % wide, u[0]), scene.domain.max.x), at(i / wide / wide, u[1]),
                     std::min(at(i / wide % wide, u[2]), scene.domain.max.z)};
  }
  auto backend = make_cpu_backend({.precision = scene.precision, .threads = 0, .isa = ""});
  if (!backend) return fail(backend.error());
  auto simulation = Simulation::create(scene, std::move(p), std::move(*backend));
  if (!simulation) return fail(simulation.error());
  if (auto settled = simulation->step(400); !settled) return fail(settled.error());
  return pools[wide] = simulation->particles();
}

// Arguments of benchmarks on a pool: balls along a side, 1 for double precision, threads, index of the instruction set
// among those available.
void pool_arguments(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"wide", "double", "threads", "isa"})->Unit(benchmark::kMillisecond);
  for (const std::int64_t wide : {20, 57, 160}) benchmark->Args({wide, 0, 2, 0});
  benchmark->Args({160, 0, 1, 0})->Args({160, 1, 2, 0})->Args({160, 0, 2, 1})->Args({160, 0, 2, 2});
}

struct Pool {
  Scene scene;
  ParticleSet particles;
  std::unique_ptr<Backend> backend;
  Isa isa;
};

Expected<Pool> open_pool(const benchmark::State& state) {
  const std::vector<Isa> isas = available_isas();
  const auto isa_index = static_cast<std::size_t>(state.range(3));
  if (isa_index >= isas.size()) return fail(Error::Kind::bad_input, "isa", "not on this processor");
  const auto wide = static_cast<std::size_t>(state.range(0));
  auto particles = settled_pool(wide);
  if (!particles) return fail(particles.error());
  Pool pool{pool_scene(wide), std::move(*particles), nullptr, isas[isa_index]};
  pool.scene.precision = state.range(1) != 0 ? Precision::double_precision : Precision::single_precision;
  auto backend = make_cpu_backend(
      {.precision = pool.scene.precision, .threads = static_cast<int>(state.range(2)), .isa = pool.isa.name});
  if (!backend) return fail(backend.error());
  pool.backend = std::move(*backend);
  return pool;
}

bool momentum_is_kept(const Measurements& now, const Ledger& ledger, const Vec3d& initial, Precision precision) {
  return momentum_drift(now, ledger, initial) < (precision == Precision::single_precision ? 1e-4 : 1e-10);
}

void report_pool(benchmark::State& state, const Pool& pool, const Measurements& now) {
  state.SetLabel(pool.isa.name);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(now.particles));
  state.counters["contacts"] = 2 * static_cast<double>(now.contacts) / static_cast<double>(now.particles);
}

void whole_step(benchmark::State& state) {
  auto pool = open_pool(state);
  if (!pool) return state.SkipWithError(pool.error().text().c_str());
  auto simulation = Simulation::create(pool->scene, std::move(pool->particles), std::move(pool->backend));
  if (!simulation) return state.SkipWithError(simulation.error().text().c_str());
  for (auto iteration : state) {
    if (auto stepped = simulation->step(); !stepped) return state.SkipWithError(stepped.error().text().c_str());
  }
  const auto now = simulation->measure();
  if (!now || !momentum_is_kept(*now, simulation->ledger(), simulation->initial_momentum(), pool->scene.precision)) {
    return state.SkipWithError("momentum drifts beyond what gravity and walls account for");
  }
  report_pool(state, *pool, *now);
}
BENCHMARK(whole_step)->Apply(pool_arguments)->UseRealTime();

// One stage of steps; every step builds the neighbour list anew.
void stage(benchmark::State& state, double StageTimes::* part, Integrator integrator) {
  auto pool = open_pool(state);
  if (!pool) return state.SkipWithError(pool.error().text().c_str());
  pool->scene.integrator = integrator;
  Backend& backend = *pool->backend;
  Ranks alone;
  RunState run;
  backend.configure(pool->scene);
  backend.assign(pool->particles);
  const Instant start_of_run = place_colliders(run, pool->scene, 0);
  if (!start_particles(pool->scene, backend, alone, run).good()) return state.SkipWithError("the pool is bad");
  const auto before = backend.measure(start_of_run);
  for (auto iteration : state) {
    const StageTimes start = backend.stage_times();
    const bool verlet = integrator == Integrator::velocity_verlet;
    RemovalSums left;
    StepReport report;
    if (verlet) {
      backend.half_kick_and_drift();
      backend.follow_motion();
      backend.remove_departed(left);
    }
    report.condition = backend.build_neighbours();
    if (report.condition.good()) backend.apply_forces(start_of_run, report);
    if (!verlet) {
      backend.follow_motion();
      backend.remove_departed(left);
    }
    if (!report.condition.good()) return state.SkipWithError("the pool went bad");
    run.ledger.book_step(report, pool->scene);
    state.SetIterationTime((backend.stage_times() - start).*part);
  }
  const auto after = backend.measure(start_of_run);
  const std::size_t colliders = pool->scene.colliders.size();
  if (!before || !after ||
      !momentum_is_kept(after->result(colliders), run.ledger.read(), before->result(colliders).momentum,
                        pool->scene.precision)) {
    return state.SkipWithError("momentum drifts beyond what gravity and walls account for");
  }
  report_pool(state, *pool, after->result(colliders));
}
void stage_arguments(benchmark::internal::Benchmark* benchmark) {
  pool_arguments(benchmark);
  benchmark->Iterations(20)->UseManualTime();
}
BENCHMARK_CAPTURE(stage, sort, &StageTimes::sort, Integrator::symplectic_euler)->Apply(stage_arguments);
BENCHMARK_CAPTURE(stage, list, &StageTimes::list, Integrator::symplectic_euler)->Apply(stage_arguments);
BENCHMARK_CAPTURE(stage, force, &StageTimes::force, Integrator::symplectic_euler)->Apply(stage_arguments);
// The stage of integration that is separate from the force stage.
BENCHMARK_CAPTURE(stage, integrate, &StageTimes::drift, Integrator::velocity_verlet)->Apply(stage_arguments);

// What a hand that leads one ball adds to the cost of a step: finding the ball, moving it, and watching it.
void hand(benchmark::State& state) {
  auto pool = open_pool(state);
  if (!pool) return state.SkipWithError(pool.error().text().c_str());
  Backend& backend = *pool->backend;
  backend.configure(pool->scene);
  backend.assign(pool->particles);
  const Instant now{0, {}};
  if (!backend.build_neighbours().good()) return state.SkipWithError("the pool is bad");
  const std::uint64_t id = pool->particles.id[pool->particles.size() / 2];
  for (auto iteration : state) {
    RemovalSums left;
    StepReport report;
    backend.apply_forces(now, report);
    backend.follow_motion();
    backend.remove_departed(left);
    if (backend.neighbours_stale() && !backend.build_neighbours().good()) {
      return state.SkipWithError("the pool went bad");
    }
    double seconds = 0;
    {
      const Stopwatch leading(seconds);
      auto ball = backend.find(id);
      ball->position.y += 1e-4;
      ball->velocity = {0, 0, 0};
      backend.edit({&*ball, 1});
      if (backend.neighbours_stale()) return state.SkipWithError("the list did not go on");
    }
    if (backend.find(id)->velocity != Vec3d{0, 0, 0}) return state.SkipWithError("the ball is not where it was put");
    state.SetIterationTime(seconds);
  }
  state.counters["lists"] = static_cast<double>(backend.neighbour_statistics().rebuilds);
  state.SetLabel(pool->isa.name);
}
BENCHMARK(hand)
    ->ArgNames({"wide", "double", "threads", "isa"})
    ->Args({160, 0, 2, 0})
    ->Iterations(60)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

// Sorting half a million cell numbers.
void sort_keys(benchmark::State& state) {
  std::vector<std::uint64_t> shuffled(static_cast<std::size_t>(state.range(0)));
  for (std::size_t i = 0; i < shuffled.size(); ++i)
    shuffled[i] = philox4x32({static_cast<std::uint32_t>(i)}, {})[0] % 1'000'000;
  std::vector<std::uint64_t> keys;
  std::vector<std::uint32_t> order;
  for (auto iteration : state) {
    state.PauseTiming();
    keys = shuffled;
    state.ResumeTiming();
    sort_by_key(keys, order);
  }
  bool right = std::is_sorted(keys.begin(), keys.end());
  for (std::size_t i = 0; i < keys.size(); ++i) right = right && shuffled[order[i]] == keys[i];
  if (!right) return state.SkipWithError("not sorted");
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(sort_keys)->Arg(512'000)->Unit(benchmark::kMillisecond)->UseRealTime();

void exact_sum(benchmark::State& state) {
  std::vector<double> values(10'000);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = std::ldexp(uniform4(1, i, 0)[0] - 0.5, static_cast<int>(i % 60));
  double forward = 0;
  for (auto iteration : state) {
    ExactSum sum;
    for (const double value : values) sum.add(value);
    benchmark::DoNotOptimize(forward = sum.value());
  }
  ExactSum backward;
  for (std::size_t i = values.size(); i-- > 0;) backward.add(values[i]);
  if (forward != backward.value()) return state.SkipWithError("the sum depends on the order");
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(values.size()));
}
BENCHMARK(exact_sum);

}  // namespace
}  // namespace hooke
