// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "hooke/core/particle_checks.h"
#include "hooke/core/scene.h"
#include "hooke/scene/block_source.h"
#include "hooke/scene/cluster_source.h"
#include "hooke/scene/particle_file.h"

namespace hooke::scene {

/// One entry of "particles", checked but not yet made.
struct ParticleSource {
  std::string path;         ///< in the scene: "particles[0]"
  ParticleFileRules rules;  ///< material and velocity are used for a block, too
  std::optional<BlockSource> block;
  std::optional<ClusterSource> cluster;
  std::string file_name;  ///< as the scene writes it
  std::filesystem::path file;
};

/// Whether any of its particles can be made without the others.
inline bool is_lattice(const ParticleSource& source) { return source.block && source.block->lattice != "random"; }

/// About how many particles it will have.
double expected_count(const ParticleSource& source);

/// The two faces of a periodic axis are the same place, which belongs to the lower face.
inline bool is_on_periodic_face(const Domain& domain, const Vec3d& x) {
  for (int axis = 0; axis < 3; ++axis) {
    const bool periodic = domain.boundary[static_cast<std::size_t>(axis)] == Boundary::periodic;
    if (periodic && component(x, axis) == component(domain.max, axis)) return true;
  }
  return false;
}

/// Whether a particle may start there.
inline bool can_start_at(const Domain& domain, const Vec3d& x) {
  return is_inside(domain, x) && !is_on_periodic_face(domain, x);
}

}  // namespace hooke::scene
