// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hooke {

/// What a back end found wrong while it worked, with the particles concerned. Devices set it, the step
/// reads it once, Simulation words it.
struct Condition {
  enum class Kind { good, not_finite, grid_overflow, pair_too_fast, wall_too_fast, collider_too_fast };
  Kind kind = Kind::good;
  std::uint64_t particle = 0;  ///< id
  std::uint64_t partner = 0;   ///< id of the other one, for pair_too_fast; index of the collider
  double speed = 0;            ///< m/s, at which they approach; below 0: they part, having passed through each other

  bool good() const { return kind == Kind::good; }

  /// The finding to report of two: the one of the lower particle id, so that it is always the same.
  static Condition first(const Condition& a, const Condition& b) {
    if (a.good()) return b;
    if (b.good()) return a;
    return b.particle < a.particle ? b : a;
  }
};

}  // namespace hooke
