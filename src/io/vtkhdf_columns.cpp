// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/vtkhdf_columns.h"

#include <algorithm>

namespace hooke::io {

namespace {

constexpr hsize_t kMostRows = 65536;   // rows of a chunk of particles: 0.8 to 1.6 MB of positions
constexpr hsize_t kFewestRows = 1024;
constexpr hsize_t kTableRows = 256;    // rows of a chunk of a table by step or part

// Snapshots start at whole chunks: chooses a chunk size that leaves little unused in the last one.
hsize_t chunk_rows_for(hsize_t particles) {
  const hsize_t chunks = std::max<hsize_t>((particles + kMostRows - 1) / kMostRows, 1);
  return std::max((particles + chunks - 1) / chunks, kFewestRows);
}

enum class Rows { particle, vertex, table };

}  // namespace

// visit(column, parent group, name, type in files, width, kind of rows) for every table of the file.
template <class Visit>
void VtkhdfColumns::visit_all(VtkhdfColumns& c, hid_t file, Visit&& visit) {
  const hid_t whole = hdf5::file_type<std::int64_t>();
  const hid_t real = 0;  // the precision of the run
  const hdf5::Handle vtk = hdf5::open_group(file, kVtkGroup);
  const hdf5::Handle point_data = hdf5::open_group(vtk.get(), "PointData");
  visit(c.points, vtk, "Points", real, 3, Rows::particle);
  visit(c.velocity, point_data, "velocity", real, 3, Rows::particle);
  visit(c.id, point_data, "id", whole, 1, Rows::particle);
  visit(c.material, point_data, "material", hdf5::file_type<std::uint16_t>(), 1, Rows::particle);
  visit(c.radius, point_data, "radius", real, 1, Rows::particle);

  visit(c.number_of_points, vtk, "NumberOfPoints", whole, 1, Rows::table);
  for (std::size_t i = 0; i < kTopologies.size(); ++i) {
    const hdf5::Handle group = hdf5::open_group(vtk.get(), kTopologies[i]);
    const Rows rows = i == 0 ? Rows::vertex : Rows::table;
    visit(c.topologies[i].number_of_cells, group, "NumberOfCells", whole, 1, Rows::table);
    visit(c.topologies[i].number_of_connectivity_ids, group, "NumberOfConnectivityIds", whole, 1, Rows::table);
    visit(c.topologies[i].offsets, group, "Offsets", whole, 1, rows);
    visit(c.topologies[i].connectivity, group, "Connectivity", whole, 1, rows);
  }

  const hdf5::Handle steps = hdf5::open_group(vtk.get(), "Steps");
  const hdf5::Handle data_offsets = hdf5::open_group(steps.get(), "PointDataOffsets");
  visit(c.values, steps, "Values", hdf5::file_type<double>(), 1, Rows::table);
  visit(c.part_offsets, steps, "PartOffsets", whole, 1, Rows::table);
  visit(c.number_of_parts, steps, "NumberOfParts", whole, 1, Rows::table);
  visit(c.point_offsets, steps, "PointOffsets", whole, 1, Rows::table);
  visit(c.cell_offsets, steps, "CellOffsets", whole, 4, Rows::table);
  visit(c.connectivity_offsets, steps, "ConnectivityIdOffsets", whole, 4, Rows::table);
  visit(c.velocity_offsets, data_offsets, "velocity", whole, 1, Rows::table);
  visit(c.id_offsets, data_offsets, "id", whole, 1, Rows::table);
  visit(c.material_offsets, data_offsets, "material", whole, 1, Rows::table);
  visit(c.radius_offsets, data_offsets, "radius", whole, 1, Rows::table);
  const hdf5::Handle hooke = hdf5::open_group(file, kHookeGroup);
  visit(c.step, hooke, "step", whole, 1, Rows::table);
  visit(c.checksum, hooke, "checksum", whole, 1, Rows::table);
}

VtkhdfColumns VtkhdfColumns::create(hid_t file, std::size_t particles, Precision precision) {
  const hdf5::Handle vtk = hdf5::open_group(file, kVtkGroup);
  hdf5::create_group(vtk.get(), "PointData");
  for (const char* name : kTopologies) hdf5::create_group(vtk.get(), name);
  const hdf5::Handle steps = hdf5::create_group(vtk.get(), "Steps");
  hdf5::write_integer_attribute(steps.get(), "NSteps", {0}, true);
  hdf5::create_group(steps.get(), "PointDataOffsets");

  const hid_t real = precision == Precision::single_precision ? hdf5::file_type<float>() : hdf5::file_type<double>();
  VtkhdfColumns columns;
  visit_all(
      columns, file,
      [&](hdf5::Column& column, const hdf5::Handle& group, const char* name, hid_t type, hsize_t width, Rows rows) {
        const hsize_t chunk_rows = rows == Rows::table ? kTableRows : chunk_rows_for(particles);
        column =
            hdf5::Column::create(group.get(), name, type == 0 ? real : type, width, chunk_rows, rows != Rows::table);
      });
  return columns;
}

VtkhdfColumns VtkhdfColumns::open(hid_t file) {
  VtkhdfColumns columns;
  visit_all(columns, file,
            [](hdf5::Column& column, const hdf5::Handle& group, const char* name, hid_t type, hsize_t width, Rows) {
              // Of either precision: both are read as double.
              column = hdf5::Column(group.get(), name, type == 0 ? hdf5::file_type<double>() : type, width);
            });
  return columns;
}

}  // namespace hooke::io
