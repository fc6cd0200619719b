// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/core/backend.h"

namespace hooke {

/// Takes one step of `integrator` on a back end: the whole algorithm, one call a physical stage. Stops at the first
/// stage that finds something wrong.
Condition take_step(Backend& backend, Integrator integrator);

}  // namespace hooke
