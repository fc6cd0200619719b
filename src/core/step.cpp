// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/step.h"

namespace hooke {

Condition take_step(Backend& backend, Integrator integrator) {
  // Velocity Verlet moves first and asks for the forces at the new positions, with the half-step velocities.
  // Symplectic Euler moves last: apply_forces() kicks and drifts in the pass that sums the forces.
  if (integrator == Integrator::velocity_verlet) backend.half_kick_and_drift();

  if (backend.neighbours_stale()) {
    if (const Condition found = backend.build_neighbours(); !found.good()) return found;
  }
  return backend.apply_forces();
}

}  // namespace hooke
