// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

// Few sources include this: OpenVDB's headers compile slowly.
#include <openvdb/openvdb.h>

#include <filesystem>
#include <vector>

#include "hooke/io/export.h"
#include "hooke/io/snapshot.h"

namespace hooke {

/// A snapshot's particles as one fluid, on grids of OpenVDB: SurfaceOptions say where its surface is. Lengths are in m,
/// and voxel (0, 0, 0) of every grid has its centre at the origin, so that the files of a run fit onto each other.
/// Throws Failure (bad_input), naming `file`, where the options are out of range or particles are too far away.
class FluidVolume {
 public:
  FluidVolume(const Snapshot& snapshot, const std::vector<MaterialInfo>& materials, const SurfaceOptions& options,
              const std::filesystem::path& file);

  /// About the distance to the surface, negative inside: exact where it is 0, and in blocks around that only.
  openvdb::FloatGrid::Ptr surface_field() const;
  /// The distance to the surface, negative inside, within three voxels of it: a level set by OpenVDB's book.
  openvdb::FloatGrid::Ptr level_set() const;
  /// The velocity (m/s) of the particles around each voxel, the mean by weight, out to beyond the surface. Its voxels
  /// are a radius of the smallest particle wide, or as wide as the surface's where those are wider.
  openvdb::Vec3SGrid::Ptr velocity() const;

 private:
  const ParticleSet& particles_;
  double voxel_;  // m
  double smallest_;  // radius, m
  double reach_ratio_;  // of a particle's reach to the radius of its sphere
  std::vector<double> reach_;  // m, of each particle
  std::vector<std::array<float, 1>> sphere_;  // m, radius of each particle's sphere
};

}  // namespace hooke
