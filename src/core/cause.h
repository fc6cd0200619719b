// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace hooke {

/// The causes of work on particles, into which the change of their kinetic energy divides.
enum class Cause : unsigned char {
  contact_spring,   ///< springs of contacts between particles, and their cohesion
  contact_shear,    ///< dashpots of such contacts on the tangential velocity
  contact_damping,  ///< dashpots of such contacts on the whole velocity
  contact_friction, ///< in place of both, where such contacts slide
  wall,             ///< walls, their springs and dashpots
  collider,         ///< colliders likewise
  drag,
  gravity,
  hold,        ///< what keeps pinned particles still
  springs,     ///< springs of the scene's structure, their dampers included
  field,  ///< fields: wind, and pushes that depend on position
  attraction,
  external,  ///< forces that the caller asks for, by id
};
inline constexpr std::size_t kCauses = 13;
/// The first causes are in every pass over the particles; the others, applied causes, only in scenes that have them.
inline constexpr std::size_t kPassCauses = static_cast<std::size_t>(Cause::hold);

}  // namespace hooke
