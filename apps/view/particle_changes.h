// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "action.h"
#include "hooke/base/expected.h"
#include "hooke/core/simulation.h"

namespace hooke::view {

// Actions on the particles of a simulation. Each is a function of the action and of the state alone, so that it has the
// same bits when it is replayed. Where one fails, nothing has changed.

/// Adds the sites of a hexagonal lattice in the ball that are inside the domain and clear of all else. bad_input where
/// there is no room for any.
Expected<void> add_ball(Simulation& simulation, const AddBall& ball);

/// bad_input where the particles find no room, or none may be moved.
Expected<void> scatter(Simulation& simulation, const Scatter& how);

}  // namespace hooke::view
