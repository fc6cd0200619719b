// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

// For this library's own sources: OpenVDB's headers compile slowly.
#include <openvdb/openvdb.h>

#include <array>
#include <span>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/particles.h"
#include "hooke/volumes/surface_options.h"

namespace hooke {

/// Particles as one fluid, on grids of OpenVDB: SurfaceOptions say where its surface is. Lengths are in m, and voxel
/// (0, 0, 0) of every grid has its centre at the origin, so that the files of a run fit onto each other.
class FluidVolume {
 public:
  /// `radius` (m) is that of each material; the particles are kept by reference. An error (bad_input), which names no
  /// place, where the options are out of range or particles are too far away.
  static Expected<FluidVolume> create(const ParticleSet& particles, std::span<const double> radius,
                                      const SurfaceOptions& options);

  /// About the distance to the surface, negative inside: exact where it is 0, and in blocks around that only.
  openvdb::FloatGrid::Ptr surface_field() const;
  /// The distance to the surface, negative inside, within three voxels of it: a level set by OpenVDB's book.
  openvdb::FloatGrid::Ptr level_set() const;
  /// The fog in it: 1 inside, falling to 0 at the surface.
  static openvdb::FloatGrid::Ptr fog(const openvdb::FloatGrid& level_set);
  /// The velocity (m/s) of the particles around each voxel, the mean by weight, out to beyond the surface. Its voxels
  /// are a radius of the smallest particle wide, or as wide as the surface's where those are wider.
  openvdb::Vec3SGrid::Ptr velocity() const;

 private:
  explicit FluidVolume(const ParticleSet& particles) : particles_(particles) {}

  const ParticleSet& particles_;
  double voxel_ = 0;  // m
  double smallest_ = 0;  // radius, m
  double reach_ratio_ = 0;  // of a particle's reach to the radius of its sphere
  std::vector<double> reach_;  // m, of each particle
  std::vector<std::array<float, 1>> sphere_;  // m, radius of each particle's sphere
};

}  // namespace hooke
