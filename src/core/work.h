// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "hooke/base/assert.h"

namespace hooke {

/// What works on the particles: the parts into which the change of their kinetic energy divides.
enum class Cause : unsigned char {
  contact_spring,   ///< springs of contacts between particles, and their cohesion
  contact_shear,    ///< dashpots of such contacts on the tangential velocity
  contact_damping,  ///< dashpots of such contacts on the whole velocity
  contact_friction, ///< in place of both, where such contacts slide
  wall,             ///< walls, their springs and dashpots
  collider,         ///< colliders likewise
  drag,
  gravity,
  hold,        ///< what keeps held particles still
  springs,     ///< springs of the scene's structure, their dampers included
  field,  ///< fields: wind, and whatever pushes by place
  attraction,
};
inline constexpr std::size_t kCauses = 12;
/// The first of them are in every pass over the particles; the others, applied causes, only in scenes that have them.
inline constexpr std::size_t kPassCauses = static_cast<std::size_t>(Cause::hold);

/// One T a cause; of the first `kCount` causes.
template <class T, std::size_t kCount = kCauses>
struct ByCause {
  std::array<T, kCount> of{};

  T& operator[](Cause cause) {
    HOOKE_ASSERT(static_cast<std::size_t>(cause) < kCount, cause, kCount);
    return of[static_cast<std::size_t>(cause)];
  }
  const T& operator[](Cause cause) const {
    HOOKE_ASSERT(static_cast<std::size_t>(cause) < kCount, cause, kCount);
    return of[static_cast<std::size_t>(cause)];
  }

  friend bool operator==(const ByCause&, const ByCause&) = default;
};

/// Work, J, or power, W, by cause: positive where it adds to the kinetic energy. The work of a force over a step is the
/// force times the step times the mean of the velocities before and after, so that the sum over all causes is what the
/// kinetic energy gains, but for rounding (docs/theory.md eq. 13).
using Work = ByCause<double>;

}  // namespace hooke
