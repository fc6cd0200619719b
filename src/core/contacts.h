// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hooke/base/vec3.h"
#include "hooke/core/particles.h"
#include "hooke/core/scene.h"

namespace hooke {

// Contacts of a snapshot, found afresh from positions and velocities: for files and pictures. The list of a running
// back end is not used. Pairs that a spring of the scene keeps apart are no contacts. All functions need particles of
// the scene (are_particles_of) at finite positions. Along periodic axes, positions should be inside the domain, as in
// snapshots: outside, contacts may be missed. Results do not depend on the number of threads.

/// A face of the domain; `none` where the partner is a particle.
enum class Face : std::uint8_t { none, x_min, x_max, y_min, y_max, z_min, z_max };

/// "x-min", "x-max", ... "z-max"; "" for none.
const char* to_string(Face face);

/// The state of a snapshot beside its particles.
struct ContactInstant {
  double time = 0;  ///< s: colliders are where they are then
  std::span<const std::uint64_t> broken_springs{};  ///< indices into the structure's, ascending: no longer apart
};

/// Two particles, or a particle and a wall or a collider, that touch, or that cohesion holds across a gap.
struct Contact {
  static constexpr std::uint32_t kWall = static_cast<std::uint32_t>(-1), kCollider = kWall - 1;

  std::uint32_t a = 0;  ///< index into the set
  std::uint32_t b = 0;  ///< index into the set, >= a; or kWall, kCollider
  Face face = Face::none;  ///< the wall
  std::array<std::int32_t, 3> image{};  ///< a touches b at x_b + image * length of the domain, axis by axis
  double overlap = 0;  ///< m; not above 0 across a gap
  Vec3d force{0, 0, 0};  ///< on a by the law of physics/contact.h, N; b takes -force
  std::uint32_t collider = 0;  ///< index into the scene's, of kCollider
  Vec3d point{0, 0, 0};  ///< on its surface, nearest to the centre of a, m
};

/// Every contact once, in order of a: its pairs by (b, image), then its walls along x, y, z, the lower first, then
/// colliders in the scene's order, face by face. A particle that touches
/// its own image across a short periodic axis is a contact with b = a.
std::vector<Contact> find_contacts(const Scene& scene, const ParticleSet& particles, const ContactInstant& now = {});

/// How much particles overlap each other.
struct Overlaps {
  double pairs = 0;  ///< touching pairs; estimated from some of the particles where there are too many
  std::uint32_t a = 0, b = 0;  ///< indices of the pair that overlaps most for its size, where there is one
  double overlap = 0;  ///< of this pair, m
  double ratio = 0;  ///< over the sum of its radii
};
/// Takes little time and memory, however many pairs overlap.
Overlaps count_overlaps(const Scene& scene, const ParticleSet& particles);

/// Figures of each particle's contacts, in the order of the set.
struct ContactFigures {
  std::vector<std::uint32_t> count;  ///< touching particles, images of its own, walls and colliders
  /// Pa: the mean stress that the contacts put on the particle, compression positive, a third of the trace of its
  /// virial over its volume: p = sum(r F_n) / (3 V), V = 4/3 pi r^3. The arm of each force is the radius r; F_n (N) is
  /// its component along the normal, springs and dashpots, which is negative where a dashpot holds a contact back.
  std::vector<double> pressure;
};
ContactFigures contact_figures(const Scene& scene, const ParticleSet& particles, const ContactInstant& now = {});

}  // namespace hooke
