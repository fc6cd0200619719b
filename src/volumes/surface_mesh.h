// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/base/vec3.h"
#include "hooke/core/particles.h"
#include "hooke/volumes/surface_options.h"

namespace hooke {

/// The surface of a fluid: a closed mesh of four-sided faces.
struct SurfaceMesh {
  std::vector<Vec3f> position;  ///< m
  std::vector<Vec3f> normal;    ///< unit vector, outward
  std::vector<Vec3f> velocity;  ///< m/s, of the fluid there
  std::vector<std::array<std::uint32_t, 4>> face;  ///< its corners, counterclockwise from outside
};

/// The surface around particles, as the options draw it; `radius` (m) is that of each material. An error, which names
/// no place, where the options are out of range or particles too far away.
Expected<SurfaceMesh> make_surface_mesh(const ParticleSet& particles, std::span<const double> radius,
                                        const SurfaceOptions& options);

}  // namespace hooke
