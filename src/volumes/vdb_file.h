// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "hooke/base/expected.h"
#include "hooke/core/particles.h"
#include "hooke/volumes/surface_options.h"

namespace hooke::volumes {

/// The description of the instant in every grid of a file.
struct VdbInstant {
  std::int64_t step = 0;
  double time = 0;  ///< s
};

// The bytes of OpenVDB files: OpenVDB's own writer does not notice a full disk. `radius` (m) has an entry per material.
// Errors name no file.

/// Particles as a grid of points, "particles", with Houdini's names of attributes: id, v (m/s), pscale (radius, m), and
/// material, an index into `material_names`, which the grid's metadata "materials" holds unchanged.
Expected<std::string> vdb_points(const ParticleSet& particles, std::span<const double> radius,
                                 const std::string& material_names, const VdbInstant& instant);

/// The fluid of the particles: "density" (fog: 1 inside, falling to 0 at the surface), "surface" (level set, m,
/// negative inside) and "vel" (m/s). Also an error where the options are out of range or particles are too far away.
Expected<std::string> vdb_volume(const ParticleSet& particles, std::span<const double> radius,
                                 const SurfaceOptions& options, const VdbInstant& instant);

}  // namespace hooke::volumes
