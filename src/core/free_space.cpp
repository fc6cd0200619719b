// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/free_space.h"

#include <algorithm>
#include <cmath>

#include "hooke/base/assert.h"
#include "hooke/base/hash.h"
#include "hooke/physics/enclosure.h"

namespace hooke {
namespace {

constexpr double kClear = 1 + 1e-5;  // times a contact distance: single precision rounds by less

double largest_radius_of_those_that_touch(const Scene& scene) {
  double largest = 0;
  for (const Material& m : scene.materials) {
    if (m.interacts) largest = std::max(largest, m.radius);
  }
  return largest;
}

std::uint64_t key_of(std::int64_t x, std::int64_t y, std::int64_t z) {
  return combine64(combine64(mix64(static_cast<std::uint64_t>(x)), static_cast<std::uint64_t>(y)),
                   static_cast<std::uint64_t>(z));
}

}  // namespace

FreeSpace::FreeSpace(const Scene& scene, std::size_t material, std::span<const PlacedCollider<double>> colliders)
    : domain_(scene.domain),
      colliders_(colliders),
      interacts_(scene.materials[material].interacts),
      radius_(scene.materials[material].radius),
      reach_(kClear * (radius_ + largest_radius_of_those_that_touch(scene))) {
  HOOKE_ASSERT(scene.materials[material].is_of_particles(), scene.materials[material].name);
}

void FreeSpace::add(const Occupant& occupant) {
  HOOKE_ASSERT(occupant.radius > 0, occupant.radius, occupant.position);
  add_images(occupant, 0);
}

// Across periodic faces, too.
void FreeSpace::add_images(Occupant occupant, int axis) {
  if (axis == 3) {
    const Vec3d& x = occupant.position;
    cells_[key_of(cell_of(x.x), cell_of(x.y), cell_of(x.z))].push_back(occupant);
    return;
  }
  add_images(occupant, axis + 1);
  if (domain_.boundary[static_cast<std::size_t>(axis)] != Boundary::periodic) return;
  double& x = component(occupant.position, axis);
  const double here = x;
  for (const double image : {here + domain_.length(axis), here - domain_.length(axis)}) {
    if (image < component(domain_.min, axis) - reach_ || image > component(domain_.max, axis) + reach_) continue;
    x = image;
    add_images(occupant, axis + 1);
  }
}

std::int64_t FreeSpace::cell_of(double x) const { return static_cast<std::int64_t>(std::floor(x / reach_)); }

bool FreeSpace::has_room_at(const Vec3d& x) const {
  if (!is_inside_domain(x) || !is_clear_of_colliders(x)) return false;
  if (!interacts_) return true;
  const std::int64_t cell[3] = {cell_of(x.x), cell_of(x.y), cell_of(x.z)};
  for (std::int64_t cx = cell[0] - 1; cx <= cell[0] + 1; ++cx) {
    for (std::int64_t cy = cell[1] - 1; cy <= cell[1] + 1; ++cy) {
      for (std::int64_t cz = cell[2] - 1; cz <= cell[2] + 1; ++cz) {
        const auto found = cells_.find(key_of(cx, cy, cz));
        if (found == cells_.end()) continue;
        for (const Occupant& other : found->second) {
          const Vec3d off = other.position - x;
          const double apart = kClear * (radius_ + other.radius);
          if (dot(off, off) < apart * apart) return false;
        }
      }
    }
  }
  return true;
}

bool FreeSpace::is_inside_domain(const Vec3d& x) const {
  for (int axis = 0; axis < 3; ++axis) {
    const Boundary boundary = domain_.boundary[static_cast<std::size_t>(axis)];
    const double at = component(x, axis), min = component(domain_.min, axis), max = component(domain_.max, axis);
    const double away = boundary == Boundary::spring ? kClear * radius_ : 0;
    if (!(at >= min + away && at <= max - away)) return false;
    if (boundary == Boundary::periodic && !(at < max)) return false;
  }
  return true;
}

bool FreeSpace::is_clear_of_colliders(const Vec3d& x) const {
  bool clear = true;
  for (const PlacedCollider<double>& collider : colliders_) {
    // Distances from a mesh are known near its surface only.
    if (!collider.shape.hollow && encloses(collider, x)) return false;
    for_each_collider_face(
        collider, x, [&](const ColliderFace<double>& face) { clear = clear && face.distance >= kClear * radius_; });
  }
  return clear;
}

}  // namespace hooke
