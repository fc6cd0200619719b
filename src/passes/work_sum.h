// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hooke {

/// What is summed of an applied force in a step. Powers are at twice the mean velocity of a kick, W, as in PassSum; the
/// force, N, by component.
struct WorkSum {
  enum { power, next_power, force, count = force + 3 };
};

}  // namespace hooke
