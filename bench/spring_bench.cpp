// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Speed of springs in whole steps: a swinging cloth with springs along sides and diagonals and to the next particle but
// one, six a particle. A wrong result has no speed: momentum and total energy must be kept.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "measured_steps.h"

namespace hooke::bench {
namespace {

constexpr double kSpacing = 0.1;  // m

// A square of `wide` x `wide` particles that moves up and down in two waves along each side.
ParticleSet waving(std::int64_t wide) {
  ParticleSet p;
  p.resize(static_cast<std::size_t>(wide * wide));
  for (std::int64_t k = 0; k < wide * wide; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double u = static_cast<double>(k % wide) / static_cast<double>(wide);
    const double v = static_cast<double>(k / wide) / static_cast<double>(wide);
    p.id[i] = i + 1;
    p.position[i] = {kSpacing * static_cast<double>(k % wide), 0, kSpacing * static_cast<double>(k / wide)};
    p.velocity[i] = {std::sin(4 * M_PI * u), std::sin(4 * M_PI * u) * std::sin(4 * M_PI * v), 0.5 * std::cos(9 * v)};
  }
  return p;
}

std::shared_ptr<const Structure> tied(std::int64_t wide) {
  auto structure = std::make_shared<Structure>();
  structure->springs.reserve(static_cast<std::size_t>(6 * wide * wide));
  const auto tie = [&](std::int64_t a, std::int64_t b, double cells, double stiffness) {
    Spring s{static_cast<std::uint64_t>(a + 1), static_cast<std::uint64_t>(b + 1), cells * kSpacing, stiffness};
    s.contact = false;
    structure->springs.push_back(s);
  };
  for (std::int64_t k = 0; k < wide * wide; ++k) {
    const bool right = k % wide + 1 < wide, up = k / wide + 1 < wide;
    if (right) tie(k, k + 1, 1, 2000);
    if (up) tie(k, k + wide, 1, 2000);
    if (right && up) tie(k, k + wide + 1, std::sqrt(2.0), 500);
    if (right && up) tie(k + 1, k + wide, std::sqrt(2.0), 500);
    if (k % wide + 2 < wide) tie(k, k + 2, 2, 100);
    if (k / wide + 2 < wide) tie(k, k + 2 * wide, 2, 100);
  }
  return structure;
}

Expected<Simulation> cloth(const benchmark::State& state) {
  const std::int64_t wide = state.range(0);
  Scene scene;
  scene.time_step = 1e-3;
  scene.gravity = {0, 0, 0};
  scene.precision = precision_of(state);
  const double side = kSpacing * static_cast<double>(wide);
  scene.domain.min = {-side, -side, -side};
  scene.domain.max = {2 * side, side, 2 * side};
  scene.domain.boundary = {Boundary::open, Boundary::open, Boundary::open};
  scene.materials = {{.name = "linen", .radius = 0.04, .mass = 0.1, .contact = {2000, 0, 0}, .drag = 0, .color = ""}};
  scene.structure = tied(wide);
  return simulate(state, std::move(scene), waving(wide));
}

void spring_steps(benchmark::State& state) {
  auto simulation = cloth(state);
  if (!simulation) return state.SkipWithError(simulation.error().text().c_str());
  const std::uint64_t springs = simulation->scene().structure->springs.size();
  const auto now = run_steps(state, *simulation, 0);
  if (!now) return state.SkipWithError(now.error().text().c_str());
  const double energy = now->kinetic_energy + now->spring_energy + now->elastic_energy;
  // Symplectic Euler's energy swings by omega dt/2 of the energy exchanged, here a few per cent.
  if (now->springs != springs || !(std::abs(energy / simulation->initial_energy() - 1) < 0.05)) {
    return state.SkipWithError("energy is not kept");
  }
  state.SetLabel(simulation->backend_info().isa);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(springs));
  state.counters["springs"] = static_cast<double>(springs);
  state.counters["rebuilds"] = static_cast<double>(simulation->neighbour_statistics().rebuilds);
}
BENCHMARK(spring_steps)
    ->ArgNames({"wide", "double", "threads"})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Args({100, 0, 2})
    ->Args({409, 0, 2})
    ->Args({1292, 0, 1})
    ->Args({1292, 0, 2})
    ->Args({1292, 1, 2});

}  // namespace
}  // namespace hooke::bench
