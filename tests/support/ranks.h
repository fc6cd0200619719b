// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "support/engines.h"
#include "support/thread_communicator.h"

namespace hooke::test {

/// Runs look(simulation) on rank 0 of so many ranks that compute a scene with these particles, by clocks that go on as
/// the cost of their boxes says.
template <class Look>
void on_ranks(int ranks, Scene scene, const ParticleSet& particles, const Engine& engine, const Look& look,
              const BoxCost& cost = {}) {
  scene.precision = engine.precision;
  run_ranks(
      ranks,
      [&](std::shared_ptr<Communicator> communicator) {
        if (communicator->rank() > 0) return Simulation::follow(scene, make_backend(engine), std::move(communicator));
        auto simulation = Simulation::create(scene, particles, make_backend(engine),
                                             {.allow_unstable_step = true, .communicator = std::move(communicator)});
        ASSERT_TRUE(simulation) << simulation.error().text();
        look(*simulation);
      },
      cost);
}

/// The same, going on from a saved state.
template <class Look>
void resume_on_ranks(int ranks, Scene scene, const SimulationState& saved, const Engine& engine, const Look& look) {
  scene.precision = engine.precision;
  run_ranks(ranks, [&](std::shared_ptr<Communicator> communicator) {
    if (communicator->rank() > 0) return Simulation::follow(scene, make_backend(engine), std::move(communicator));
    auto simulation = Simulation::resume(scene, saved, make_backend(engine), std::move(communicator));
    ASSERT_TRUE(simulation) << simulation.error().text();
    look(*simulation);
  });
}

}  // namespace hooke::test
