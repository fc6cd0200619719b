// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "hooke/base/vec3.h"
#include "hooke/physics/collider.h"
#include "hooke/physics/contact.h"
#include "hooke/physics/periodic.h"
#include "hooke/physics/wall.h"

namespace hooke {

// Visits what acts on one particle, pair by pair and wall by wall, in double precision: shared by the specification,
// the CPU back end's checks and exports. The force pass has its own loops, over packs.

/// Which periodic image of the other particle: whole numbers of lengths along each axis.
using ImageIndex = std::array<std::int32_t, 3>;

/// Which images of particles to visit.
struct PeriodicImages {
  Vec3d period{0, 0, 0};  ///< m, of periodic axes; 0 for the others
  ImageIndex most{};           ///< images -n to n along a periodic axis; 0: the nearest alone
};

/// visit(image, x_ip) for every image of p that may touch i, ascending: x_ip (m) points from the image to i
/// (docs/theory.md eq. 5). One of them is the particle itself where i is p: ImageIndex{}.
template <class Visit>
void for_each_image(const Vec3d& x_i, const Vec3d& x_p, const PeriodicImages& images, const Visit& visit) {
  ImageIndex from{}, to{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double length = component(images.period, axis);
    if (length == 0) continue;
    const double nearest = nearest_image(component(x_i, axis), component(x_p, axis), length);
    from[a] = images.most[a] > 0 ? -images.most[a] : static_cast<std::int32_t>(nearest);
    to[a] = images.most[a] > 0 ? images.most[a] : from[a];
  }
  for (std::int32_t sx = from[0]; sx <= to[0]; ++sx) {
    for (std::int32_t sy = from[1]; sy <= to[1]; ++sy) {
      for (std::int32_t sz = from[2]; sz <= to[2]; ++sz) {
        visit(ImageIndex{sx, sy, sz}, Vec3d{image_displacement<double>(x_i.x, x_p.x, sx, images.period.x),
                                            image_displacement<double>(x_i.y, x_p.y, sy, images.period.y),
                                            image_displacement<double>(x_i.z, x_p.z, sz, images.period.z)});
      }
    }
  }
}

/// The geometry of a pair of particles, as contact laws need it.
struct PairGeometry {
  double overlap = 0;     ///< m, below 0 where they don't touch
  Vec3d normal{1, 0, 0};  ///< unit vector from p to i
};

/// The geometry of particle i and an image of p; `x_ip` points from the image to i. `contact_distance`: r_i + r_p, m.
/// `tie`: as of contact_normal().
inline PairGeometry pair_geometry(const Vec3d& x_ip, double contact_distance, double tie) {
  const double distance = sqrt_of(dot(x_ip, x_ip));
  return {contact_distance - distance, contact_normal(x_ip, distance, tie)};
}

/// Whether a contact changes too fast for steps: its two sides approach by more than the smaller `radius` (m) in one.
/// `approach`: dot(w, normal) times the time step, m.
inline bool approaches_too_fast(double approach, double radius) { return approach > radius; }

/// Whether two particles that touch have passed through each other in the last step: they part by more than the smaller
/// `radius` and by more than their `distance` (m), so their centres were on other sides of each other before.
inline bool passed_through(double approach, double radius, double distance) {
  return -approach > std::max(radius, distance);
}

/// Whether a particle at x (m) has passed through a collider in the last step, in which it moved by `motion` (m)
/// relative to `face`: it parts from the face by more than its `radius`, and the collider's face at its place before
/// looks the other way.
template <class S>
bool passed_through(const PlacedCollider<S>& collider, const ColliderFace<double>& face, const Vec3d& x,
                    const Vec3d& motion, double radius) {
  if (!(dot(motion, face.normal) > radius)) return false;
  bool opposite = false;
  for_each_collider_face(collider, x - motion, [&](const ColliderFace<double>& before) {
    opposite = opposite || dot(before.normal, face.normal) < 0;
  });
  return opposite;
}

/// The walls of a domain.
struct Walls {
  std::array<bool, 3> across{};  ///< whether there are two across this axis
  Vec3d min{0, 0, 0}, max{0, 0, 0};  ///< m
};

/// visit(face, normal, overlap) for every wall that acts on a particle at x (m), by axis, the lower face first: walls
/// that overlap it, and walls within the `range` (m) of cohesion. face: 2 axis, and 1 more for the upper.
template <class Visit>
void for_each_wall(const Walls& walls, const Vec3d& x, double radius, double range, const Visit& visit) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!walls.across[static_cast<std::size_t>(axis)]) continue;
    const double lower = lower_wall_overlap(component(x, axis), component(walls.min, axis), radius);
    const double upper = upper_wall_overlap(component(x, axis), component(walls.max, axis), radius);
    if (lower > -range) visit(2 * axis, wall_normal(axis, 1.0), lower);
    if (upper > -range) visit(2 * axis + 1, wall_normal(axis, -1.0), upper);
  }
}

}  // namespace hooke
