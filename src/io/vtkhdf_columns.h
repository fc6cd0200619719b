// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hooke/io/hdf5.h"
#include "hooke/io/snapshot.h"

namespace hooke::io {

/// Groups of a particles.vtkhdf: the one that VTK reads and the one that it ignores.
inline constexpr const char* kVtkGroup = "VTKHDF";
inline constexpr const char* kHookeGroup = "Hooke";

/// One kind of cell of a PolyData. Particles are Vertices; the other kinds must exist and stay empty.
struct VtkTopology {
  hdf5::Column number_of_cells, number_of_connectivity_ids, offsets, connectivity;
};

/// The tables of a particles.vtkhdf, by their names in the VTKHDF specification.
struct VtkhdfColumns {
  static constexpr std::array<const char*, 4> kTopologies{"Vertices", "Lines", "Polygons", "Strips"};

  // By particle: the rows of a snapshot are contiguous.
  hdf5::Column points, velocity, id, material, radius;
  // By part: a number of particles and its list of vertices, shared by snapshots.
  hdf5::Column number_of_points;
  std::array<VtkTopology, 4> topologies;
  // By step: the position of its rows.
  hdf5::Column values, part_offsets, number_of_parts, point_offsets, cell_offsets, connectivity_offsets;
  hdf5::Column velocity_offsets, id_offsets, material_offsets, radius_offsets;
  hdf5::Column step, checksum;  // Hooke's own: the step number, and the checksum of the snapshot (io/checksum.h)

  /// Creates empty tables, with chunks that suit snapshots of this many particles.
  static VtkhdfColumns create(hid_t file, std::size_t particles, Precision precision);
  static VtkhdfColumns open(hid_t file);

 private:
  template <class Visit>
  static void visit_all(VtkhdfColumns& columns, hid_t file, Visit&& visit);
};

}  // namespace hooke::io
