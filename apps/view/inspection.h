// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hooke/core/simulation.h"

namespace hooke::view {

/// One particle as it is now, and what touches it.
struct Inspection {
  ParticleAt particle;
  struct Touch {
    std::string partner;   ///< "particle 17", "wall x-min", "collider drum"
    double overlap = 0;    ///< m
    Vec3d force{0, 0, 0};  ///< on the particle, N
  };
  std::vector<Touch> contacts;
  Vec3d force{0, 0, 0};  ///< of all contacts, N
};

/// Nothing where there is no particle of this id. The first call after a step copies all particles.
std::optional<Inspection> inspect_particle(const Simulation& simulation, std::uint64_t id);

}  // namespace hooke::view
