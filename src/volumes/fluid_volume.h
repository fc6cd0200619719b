// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

// Only for this library's own sources, because OpenVDB's headers compile slowly.
#include <openvdb/openvdb.h>

#include <array>
#include <span>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/particles.h"
#include "hooke/volumes/surface_options.h"

namespace hooke::volumes {

/// Particles as one fluid, on OpenVDB grids: SurfaceOptions define the fluid's surface. Lengths are in m. Voxel (0, 0,
/// 0) of every grid has its centre at the origin, so that the grids of a run's files coincide.
class FluidVolume {
 public:
  /// `radius` (m) has an entry per material; the particles are kept by reference. An error (bad_input) that names no
  /// file where the options are out of range or particles are too far away.
  static Expected<FluidVolume> create(const ParticleSet& particles, std::span<const double> radius,
                                      const SurfaceOptions& options);

  /// Approximate distance to the surface, negative inside: exact where it is 0; only in blocks around the surface.
  openvdb::FloatGrid::Ptr surface_field() const;
  /// The distance to the surface, negative inside, within three voxels of it: a level set as OpenVDB defines it.
  openvdb::FloatGrid::Ptr level_set() const;
  /// Makes a fog volume of a level set: 1 inside, falling to 0 at the surface.
  static openvdb::FloatGrid::Ptr fog(const openvdb::FloatGrid& level_set);
  /// The velocity (m/s) around each voxel, the weighted mean over its particles, out to beyond the surface. A voxel is
  /// as wide as the radius of the smallest particle, or as the surface's voxels where those are wider.
  openvdb::Vec3SGrid::Ptr velocity() const;

 private:
  explicit FluidVolume(const ParticleSet& particles) : particles_(particles) {}

  const ParticleSet& particles_;
  double voxel_ = 0;  // m
  double smallest_ = 0;  // radius, m
  double reach_ratio_ = 0;  // a particle's reach / the radius of its sphere
  std::vector<double> reach_;  // m, of each particle
  std::vector<std::array<float, 1>> sphere_;  // m, radius of each particle's sphere
};

}  // namespace hooke::volumes
