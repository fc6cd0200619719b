// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/volumes/vdb_file.h"

#include <openvdb/io/Archive.h>
#include <openvdb/points/PointConversion.h>

#include <ios>
#include <sstream>
#include <utility>
#include <vector>

#include "hooke/volumes/fluid_volume.h"
#include "hooke/volumes/no_throw.h"

namespace hooke::volumes {

namespace {

namespace points = openvdb::points;

/// OpenVDB's writer, into memory.
class Bytes : private openvdb::io::Archive {
 public:
  static std::string of(const openvdb::GridPtrVec& grids) {
    std::ostringstream out(std::ios::binary);
    out.exceptions(std::ios::badbit | std::ios::failbit);
    Bytes().write(out, grids, /*seekable=*/true);
    return std::move(out).str();
  }

 private:
  using Archive::write;
};

std::string to_bytes(const openvdb::GridPtrVec& grids, const VdbInstant& instant) {
  for (const openvdb::GridBase::Ptr& grid : grids) {
    grid->setCreator("Hooke");
    grid->insertMeta("step", openvdb::Int64Metadata(instant.step));
    grid->insertMeta("time", openvdb::DoubleMetadata(instant.time));
  }
  return Bytes::of(grids);
}

/// Gives every point of the grid the value of its index in the set.
template <class Value, class Get>
void add_attribute(points::PointDataGrid& grid, const openvdb::tools::PointIndexGrid& index, const char* name,
                   std::size_t count, const Get& get) {
  std::vector<Value> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = get(i);
  points::appendAttribute<Value>(grid.tree(), name);
  points::populateAttribute(grid.tree(), index.tree(), name, points::PointAttributeVector<Value>(values));
}

openvdb::GridBase::Ptr point_grid(const ParticleSet& p, std::span<const double> radius,
                                  const std::string& material_names) {
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
                         [&](std::size_t i) { return static_cast<float>(radius[p.material[i]]); });
    add_attribute<std::int32_t>(*grid, *index, "material", p.size(), [&](std::size_t i) { return p.material[i]; });
  }
  grid->insertMeta("materials", openvdb::StringMetadata(material_names));
  return grid;
}

openvdb::GridPtrVec volume_grids(const FluidVolume& fluid) {
  const openvdb::FloatGrid::Ptr surface = fluid.level_set();
  surface->setName("surface");
  const openvdb::FloatGrid::Ptr density = FluidVolume::fog(*surface);
  density->setName("density");
  const openvdb::Vec3SGrid::Ptr velocity = fluid.velocity();
  velocity->setName("vel");
  return {density, surface, velocity};
}

}  // namespace

Expected<std::string> vdb_points(const ParticleSet& particles, std::span<const double> radius,
                                 const std::string& material_names, const VdbInstant& instant) {
  return no_throw([&]() -> Expected<std::string> {
    openvdb::initialize();
    return to_bytes({point_grid(particles, radius, material_names)}, instant);
  });
}

Expected<std::string> vdb_volume(const ParticleSet& particles, std::span<const double> radius,
                                 const SurfaceOptions& options, const VdbInstant& instant) {
  return no_throw([&]() -> Expected<std::string> {
    const auto fluid = FluidVolume::create(particles, radius, options);
    if (!fluid) return fail(fluid.error());
    return to_bytes(volume_grids(*fluid), instant);
  });
}

}  // namespace hooke::volumes
