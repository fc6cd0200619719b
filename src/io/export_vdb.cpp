// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// OpenVDB, one file a snapshot. Particles: a grid of points with attributes by Houdini's names: id, v (m/s), pscale
// (radius, m), material (counting in the metadata "materials"). Volume: "density" (fog: 1 inside, falling to 0 at the
// surface), "surface" (level set, m, negative inside) and "vel" (m/s). Each grid says its step and time.
#include <openvdb/points/PointConversion.h>
#include <openvdb/tools/LevelSetUtil.h>

#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/fluid_volume.h"
#include "hooke/io/output_file.h"

namespace hooke {

namespace {

namespace fs = std::filesystem;
namespace points = openvdb::points;

void write_file(openvdb::GridPtrVec grids, const Snapshot& snapshot, const fs::path& file) {
  for (const openvdb::GridBase::Ptr& grid : grids) {
    grid->setCreator("Hooke");
    grid->insertMeta("step", openvdb::Int64Metadata(snapshot.step));
    grid->insertMeta("time", openvdb::DoubleMetadata(snapshot.time));
  }
  const fs::path unfinished = unfinished_name(file);
  try {
    openvdb::io::File(unfinished.string()).write(grids);
  } catch (const openvdb::Exception& failure) {
    std::error_code ignored;
    fs::remove(unfinished, ignored);
    throw Failure(Error::Kind::io, file, std::string("can't be written: ") + failure.what());
  }
  publish(file);
}

/// Gives every point of the grid a value, by the index that it has in the set.
template <class Value, class Get>
void add_attribute(points::PointDataGrid& grid, const openvdb::tools::PointIndexGrid& index, const char* name,
                   std::size_t count, const Get& get) {
  std::vector<Value> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = get(i);
  points::appendAttribute<Value>(grid.tree(), name);
  points::populateAttribute(grid.tree(), index.tree(), name, points::PointAttributeVector<Value>(values));
}

openvdb::GridBase::Ptr point_grid(const Snapshot& snapshot, const std::vector<MaterialInfo>& materials) {
  const ParticleSet& p = snapshot.particles;
  std::vector<openvdb::Vec3d> positions;
  positions.reserve(p.size());
  for (const Vec3d& x : p.position) positions.emplace_back(x.x, x.y, x.z);
  const points::PointAttributeVector<openvdb::Vec3d> position(positions);
  constexpr int kPointsPerVoxel = 8;
  const double voxel = p.empty() ? 1 : points::computeVoxelSize(position, kPointsPerVoxel);
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  const auto index = openvdb::tools::createPointIndexGrid<openvdb::tools::PointIndexGrid>(position, *transform);
  const auto grid = points::createPointDataGrid<points::NullCodec, points::PointDataGrid>(*index, position, *transform);
  grid->setName("particles");
  if (!p.empty()) {
    add_attribute<std::int64_t>(*grid, *index, "id", p.size(),
                                [&](std::size_t i) { return static_cast<std::int64_t>(p.id[i]); });
    add_attribute<openvdb::Vec3s>(*grid, *index, "v", p.size(), [&](std::size_t i) {
      return openvdb::Vec3s(openvdb::Vec3d(p.velocity[i].x, p.velocity[i].y, p.velocity[i].z));
    });
    add_attribute<float>(*grid, *index, "pscale", p.size(),
                         [&](std::size_t i) { return static_cast<float>(materials[p.material[i]].radius); });
    add_attribute<std::int32_t>(*grid, *index, "material", p.size(), [&](std::size_t i) { return p.material[i]; });
  }
  std::string names;
  for (const MaterialInfo& m : materials) names += (names.empty() ? "" : ",") + m.name;
  grid->insertMeta("materials", openvdb::StringMetadata(names));
  return grid;
}

openvdb::GridPtrVec volume_grids(const FluidVolume& fluid) {
  const openvdb::FloatGrid::Ptr surface = fluid.level_set();
  surface->setName("surface");
  const openvdb::FloatGrid::Ptr density = surface->deepCopy();
  openvdb::tools::sdfToFogVolume(*density);
  density->setName("density");
  const openvdb::Vec3SGrid::Ptr velocity = fluid.velocity();
  velocity->setName("vel");
  return {density, surface, velocity};
}

}  // namespace

std::vector<fs::path> export_vdb_points(const ExportJob& job) {
  openvdb::initialize();
  return export_each(job, [&](std::size_t index, const fs::path& file) {
    const Snapshot snapshot = take(job.run.read(index));
    write_file({point_grid(snapshot, job.run.info().materials)}, snapshot, file);
  });
}

std::vector<fs::path> export_vdb_volume(const ExportJob& job) {
  return export_each(job, [&](std::size_t index, const fs::path& file) {
    const Snapshot snapshot = take(job.run.read(index));
    write_file(volume_grids(FluidVolume(snapshot, job.run.info().materials, job.options.surface, file)), snapshot,
               file);
  });
}

}  // namespace hooke
