// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hooke/core/backend.h"
#include "hooke/core/communicator.h"
#include "hooke/core/emission.h"
#include "hooke/core/ledger_sums.h"

namespace hooke {

/// Where a run is: all that its steps move on beside the particles, which the back end holds.
struct RunState {
  std::int64_t step = 0;            ///< steps done
  std::uint64_t next_id = 1;        ///< of the next particle to be added
  std::vector<ColliderPose> poses;  ///< of the scene's colliders, by place_colliders()
  Emission emission;                ///< births and deaths to come
  LedgerSums ledger;                ///< sums over all steps so far, of this rank's particles
};

/// Puts the colliders of the scene to where they are after `step` steps. The instant of that.
Instant place_colliders(RunState& run, const Scene& scene, std::int64_t step);

/// Takes one step, the whole algorithm in its order. Stops at the first stage that finds something wrong: the step is
/// not counted then, and no further one is possible.
Condition take_step(const Scene& scene, Backend& backend, Communicator& ranks, RunState& run);

/// Makes the neighbour list fresh where it must be. Every step does so when it needs one; after the last of several
/// steps it tells at once what the next would find wrong with the particles.
Condition update_neighbours(Backend& backend, Communicator& ranks);

/// Velocity Verlet: gives all particles the accelerations that the first step begins with. Under symplectic Euler there
/// is nothing to do.
Condition start_particles(const Scene& scene, Backend& backend, Communicator& ranks, RunState& run);

}  // namespace hooke
