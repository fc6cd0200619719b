// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hooke/base/vec3.h"
#include "hooke/core/particles.h"
#include "hooke/core/scene.h"

namespace hooke {

// Contacts of a snapshot, found afresh from positions and velocities: for files and pictures. A running back end has
// its own list and is not asked. Both functions want materials below scene.materials.size() and, along periodic axes,
// positions inside the domain, as snapshots have them. Their results do not depend on the number of threads.

/// A face of the domain; `none` where the partner is a particle.
enum class Face : std::uint8_t { none, x_min, x_max, y_min, y_max, z_min, z_max };

/// "x-min", "x-max", ... "z-max"; "" for none.
const char* to_string(Face face);

/// Two particles, or a particle and a wall, that touch.
struct Contact {
  static constexpr std::uint32_t kWall = static_cast<std::uint32_t>(-1);

  std::uint32_t a = 0;                    ///< index into the set
  std::uint32_t b = 0;                    ///< index into the set, >= a; kWall for a wall
  Face face = Face::none;                 ///< the wall
  std::array<std::int32_t, 3> image{};    ///< a touches b at x_b + image * length of the domain, axis by axis
  double overlap = 0;                     ///< m, > 0
  Vec3d force{0, 0, 0};                   ///< on a by the law of physics/contact.h, N; b takes -force
};

/// Every contact once, by a; a's by (b, image), then its walls along x, y, z, the lower first. A particle that touches
/// its own image across a short periodic axis is a contact with b = a.
std::vector<Contact> find_contacts(const Scene& scene, const ParticleSet& particles);

/// What the contacts do to each particle, in the order of the set.
struct ContactFigures {
  std::vector<std::uint32_t> count;  ///< touching particles, images of its own and walls
  /// Pa: the mean stress that the contacts put on the particle, compression positive, a third of the trace of its
  /// virial over its volume: p = sum(r F_n) / (3 V), V = 4/3 pi r^3. The arm of each force is the radius r; F_n (N) is
  /// its component along the normal, springs and dashpots, which is negative where a dashpot holds a contact back.
  std::vector<double> pressure;
};
ContactFigures contact_figures(const Scene& scene, const ParticleSet& particles);

}  // namespace hooke
