// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hooke/core/backend.h"
#include "hooke/core/emission.h"
#include "hooke/core/ledger_sums.h"
#include "hooke/core/ranks.h"

namespace hooke {

/// The state of a run that its steps advance, without the particles, which the back end holds.
struct RunState {
  std::int64_t step = 0;            ///< steps done
  std::uint64_t next_id = 1;        ///< of the next particle to be added
  std::vector<ColliderPose> poses;  ///< of the scene's colliders, by place_colliders()
  Emission emission;                ///< births and deaths to come
  LedgerSums ledger;                ///< sums over all steps so far, of this rank's particles
};

/// Moves the colliders of the scene to their poses after `step` steps. Returns that instant.
Instant place_colliders(RunState& run, const Scene& scene, std::int64_t step);

/// Takes one step, the whole algorithm in its order, or up to `most` at once where the back end can do so and nothing
/// has to happen in between. Stops at the first stage that finds something wrong: the step is not counted then, and no
/// further one is possible.
Condition take_step(const Scene& scene, Backend& backend, Ranks& ranks, RunState& run, std::int64_t most = 1);

/// Rebuilds the neighbour list where it is stale. Every step does so; after the last of several steps, it reports at
/// once what the next step would find wrong with the particles.
Condition update_neighbours(Backend& backend, Ranks& ranks);

/// Velocity Verlet: gives all particles the accelerations that the first step begins with. Under symplectic Euler there
/// is nothing to do.
Condition start_particles(const Scene& scene, Backend& backend, Ranks& ranks, RunState& run);

}  // namespace hooke
