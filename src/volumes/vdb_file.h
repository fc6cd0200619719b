// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "hooke/base/expected.h"
#include "hooke/core/particles.h"
#include "hooke/volumes/surface_options.h"

namespace hooke {

/// What every grid of a file says of the instant it shows.
struct VdbInstant {
  std::int64_t step = 0;
  double time = 0;  ///< s
};

// Files of OpenVDB. `radius` (m) is that of each material. Errors name no place; where a file could not be written,
// nothing of it is left.

/// Particles as a grid of points, "particles", with attributes by Houdini's names: id, v (m/s), pscale (radius, m),
/// material, an index into `material_names`, which the grid's metadata "materials" holds as it is.
Expected<void> write_vdb_points(const ParticleSet& particles, std::span<const double> radius,
                                const std::string& material_names, const VdbInstant& instant,
                                const std::filesystem::path& file);

/// The fluid that the particles are: "density" (fog: 1 inside, falling to 0 at the surface), "surface" (level set, m,
/// negative inside) and "vel" (m/s). An error too where the options are out of range or particles too far away.
Expected<void> write_vdb_volume(const ParticleSet& particles, std::span<const double> radius,
                                const SurfaceOptions& options, const VdbInstant& instant,
                                const std::filesystem::path& file);

}  // namespace hooke
