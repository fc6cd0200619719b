// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <utility>

#include "hooke/backends/cpu/cpu_backend.h"
#include "hooke/core/simulation.h"

namespace hooke::bench {

// Shared by benchmarks of whole steps. Their arguments are: the case measured, 1 for double precision, threads.

inline Precision precision_of(const benchmark::State& state) {
  return state.range(1) != 0 ? Precision::double_precision : Precision::single_precision;
}

/// A simulation in the scene's precision, on the threads of `state`.
inline Expected<Simulation> simulate(const benchmark::State& state, Scene scene, ParticleSet particles) {
  auto backend = make_cpu_backend({scene.precision, static_cast<int>(state.range(2)), ""});
  if (!backend) return fail(backend.error());
  return Simulation::create(std::move(scene), std::move(particles), std::move(*backend));
}

/// Takes `warmup` steps, then the timed steps. Returns the measurements after them; an error where the momentum is not
/// accounted for.
inline Expected<Measurements> run_steps(benchmark::State& state, Simulation& simulation, std::int64_t warmup) {
  if (auto stepped = simulation.step(warmup); !stepped) return fail(stepped.error());
  for (auto iteration : state) {
    if (auto stepped = simulation.step(); !stepped) return fail(stepped.error());
  }
  auto now = simulation.measure();
  if (!now) return fail(now.error());
  const double rounding = precision_of(state) == Precision::single_precision ? 1e-5 : 1e-12;
  if (!(momentum_drift(*now, simulation.ledger(), simulation.initial_momentum()) < rounding)) {
    return fail(Error::Kind::run_failed, "momentum", "is not accounted for");
  }
  return now;
}

}  // namespace hooke::bench
