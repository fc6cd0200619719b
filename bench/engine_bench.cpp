// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Speed of the engine's parts and of whole steps, each with a check of what it computed: a wrong result has no speed.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "hooke/backends/cpu/cpu_backend.h"
#include "hooke/backends/cpu/isa.h"
#include "hooke/base/exact_sum.h"
#include "hooke/base/random.h"
#include "hooke/core/simulation.h"
#include "hooke/neighbours/cell_grid.h"

namespace hooke {
namespace {

constexpr double kRadius = 0.2;
constexpr std::size_t kLayers = 20;

// A pool of `wide` x `wide` x 20 balls, a little jittered, that has come to rest for the most part.
Expected<Simulation> make_pool(std::size_t wide, Precision precision, int threads, const std::string& isa) {
  Scene scene;
  scene.name = "pool";
  scene.precision = precision;
  scene.materials = {
      {.name = "water", .radius = kRadius, .mass = 1, .contact = {8000, 0.3, 2}, .drag = 0, .color = ""}};
  const double side = 2 * kRadius * static_cast<double>(wide);
  scene.domain.max = {side, 4 * kRadius * kLayers, side};
  ParticleSet p;
  p.resize(wide * wide * kLayers);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto u = uniform4(1, i, 0);
    const auto at = [](std::size_t index, double random) {
      return kRadius * (1 + 2 * static_cast<double>(index) + 0.2 * (random - 0.5));
    };
    p.id[i] = i + 1;
    p.position[i] = {std::min(at(i % wide, u[0]), side), at(i / wide / wide, u[1]),
                     std::min(at(i / wide % wide, u[2]), side)};
  }
  auto backend = make_cpu_backend({.precision = precision, .threads = threads, .isa = isa});
  if (!backend) return fail(backend.error());
  auto simulation = Simulation::create(scene, std::move(p), std::move(*backend));
  if (!simulation) return simulation;
  if (auto settled = simulation->step(400); !settled) return fail(settled.error());
  return simulation;
}

// Whole steps; arguments: balls along a side, double precision or not, threads, instruction set of those there are.
void whole_step(benchmark::State& state) {
  const std::vector<Isa> isas = available_isas();
  const auto isa_index = static_cast<std::size_t>(state.range(3));
  if (isa_index >= isas.size()) return state.SkipWithError("not on this processor");
  const Precision precision = state.range(1) != 0 ? Precision::double_precision : Precision::single_precision;
  auto pool = make_pool(static_cast<std::size_t>(state.range(0)), precision, static_cast<int>(state.range(2)),
                        isas[isa_index].name);
  if (!pool) return state.SkipWithError(pool.error().text().c_str());
  for (auto iteration : state) {
    if (auto stepped = pool->step(); !stepped) return state.SkipWithError(stepped.error().text().c_str());
  }
  const auto now = pool->measure();
  const double limit = precision == Precision::single_precision ? 1e-4 : 1e-10;
  if (!now || !(momentum_drift(*now, pool->ledger(), pool->initial_momentum()) < limit)) {
    return state.SkipWithError("momentum drifts beyond what gravity and walls account for");
  }
  state.SetLabel(isas[isa_index].name);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pool->particle_count()));
  state.counters["contacts"] = 2 * static_cast<double>(now->contacts) / static_cast<double>(now->particles);
}
BENCHMARK(whole_step)
    ->ArgNames({"wide", "double", "threads", "isa"})
    ->Args({20, 0, 2, 0})
    ->Args({57, 0, 2, 0})
    ->Args({160, 0, 2, 0})
    ->Args({160, 0, 1, 0})
    ->Args({160, 1, 2, 0})
    ->Args({160, 0, 2, 1})
    ->Args({160, 0, 2, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

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
