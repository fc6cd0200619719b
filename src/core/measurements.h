// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hooke/base/vec3.h"
#include "hooke/core/colliders.h"

namespace hooke {

/// Figures of one instant. Sums are exact before one last rounding.
struct Measurements {
  std::uint64_t particles = 0;
  std::uint64_t contacts = 0;             ///< touching pairs of particles, each counted once
  std::uint64_t wall_contacts = 0;
  double kinetic_energy = 0;              ///< J
  double potential_energy = 0;            ///< -sum m g.x, J
  double elastic_energy = 0;              ///< in the springs between particles, cohesion included, J
  double wall_elastic_energy = 0;         ///< in the springs of walls, J
  std::uint64_t springs = 0;              ///< that hold
  double spring_energy = 0;               ///< in them, J
  double attraction_energy = 0;           ///< of all pairs of particles, J, <= 0
  Vec3d momentum{0, 0, 0};                ///< kg m/s
  Vec3d centre_of_mass{0, 0, 0};          ///< m
  double momentum_scale = 0;              ///< sum of m |v|, kg m/s: what rounding of the momentum is relative to
  double max_speed = 0;                   ///< m/s
  double max_overlap_ratio = 0;           ///< deepest contact: of a pair overlap / (r_i + r_p), with a wall or a
                                          ///< collider overlap / r_i
  double max_pair_overlap_ratio = 0;      ///< of pairs alone
  double mean_overlap_ratio = 0;          ///< mean over touching pairs
  Vec3d min{0, 0, 0}, max{0, 0, 0};       ///< box around the centres, m; 0 where there is none
  Vec3d wall_force{0, 0, 0};              ///< by walls on particles at this instant, N
  double collider_elastic_energy = 0;     ///< in the springs of colliders, J
  std::vector<ColliderLoad> colliders;    ///< the load of particles on each at this instant
};

}  // namespace hooke
