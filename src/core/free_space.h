// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "hooke/core/backend.h"
#include "hooke/physics/collider.h"

namespace hooke {

/// Where particles of one material can be put: inside the domain, clear of walls and colliders and, where the material
/// touches other particles, clear of these, by a little more than rounding.
class FreeSpace {
 public:
  /// `material` (index) is a material of particles. Colliders are placed with a reach of at least its radius.
  FreeSpace(const Scene& scene, std::size_t material, std::span<const PlacedCollider<double>> colliders);

  /// Largest distance between the centres of one of these particles and of another that touches it, m.
  double reach() const { return reach_; }

  /// Adds a particle that touches others, in or near the domain.
  void add(const Occupant& occupant);

  bool has_room_at(const Vec3d& x) const;

 private:
  bool is_inside_domain(const Vec3d& x) const;
  bool is_clear_of_colliders(const Vec3d& x) const;
  void add_images(Occupant occupant, int axis);
  std::int64_t cell_of(double x) const;

  const Domain& domain_;
  std::span<const PlacedCollider<double>> colliders_;
  bool interacts_;
  double radius_;  // m
  double reach_;   // m, also the edge of a cell
  std::unordered_map<std::uint64_t, std::vector<Occupant>> cells_;
};

}  // namespace hooke
