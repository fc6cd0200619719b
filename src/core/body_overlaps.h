// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/contacts.h"
#include "hooke/core/particle_slices.h"

namespace hooke {

/// What particles do with one wall or one collider, their images across periodic faces included.
struct BodyOverlap {
  Face face = Face::none;      ///< of a wall; none: a collider
  std::uint32_t collider = 0;  ///< index into the scene's
  std::uint64_t touching = 0;  ///< particles that overlap it
  std::uint64_t inside = 0;    ///< particles with their centres inside the solid; for a plane, behind it
  std::uint64_t deepest = 0;   ///< id of the particle that overlaps it most for its size, if any does
  double ratio = 0;  ///< this overlap over the particle's radius; of those deep inside a mesh it is not known
};

/// Every wall and every collider that particles of the scene (are_particles_of) overlap or are inside of at `time` (s):
/// walls in the order of faces, then colliders in the scene's. Takes time and memory as there are particles.
std::vector<BodyOverlap> find_body_overlaps(const Scene& scene, const ParticleSet& particles, double time = 0);

/// The same for particles in slices; an error where they can't be visited.
Expected<std::vector<BodyOverlap>> find_body_overlaps_in_slices(const Scene& scene, const ParticleSlices& particles,
                                                                double time = 0);

}  // namespace hooke
