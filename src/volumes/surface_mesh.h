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

namespace hooke::volumes {

/// The surface of a fluid: a closed mesh of four-sided faces.
struct SurfaceMesh {
  std::vector<Vec3f> position;  ///< m
  std::vector<Vec3f> normal;    ///< unit vector, outward
  std::vector<Vec3f> velocity;  ///< m/s, of the fluid at the vertex
  std::vector<std::array<std::uint32_t, 4>> face;  ///< corners, counterclockwise from outside
};

/// The surface around particles, drawn with the options; `radius` (m) has an entry per material. An error that names no
/// file where the options are out of range or particles are too far away.
Expected<SurfaceMesh> make_surface_mesh(const ParticleSet& particles, std::span<const double> radius,
                                        const SurfaceOptions& options);

}  // namespace hooke::volumes
