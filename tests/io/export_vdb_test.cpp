// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Reads the files back with OpenVDB.
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointDataGrid.h>

#include <map>
#include <numbers>

#include "hooke/io/export.h"
#include "samples.h"

namespace hooke {
namespace {

namespace points = openvdb::points;

class ExportVdb : public testing::Test {
 protected:
  ExportVdb() { openvdb::initialize(); }

  /// The grids of a snapshot's file, by name.
  std::map<std::string, openvdb::GridBase::Ptr> exported(const io::RunInfo& info, const Snapshot& snapshot,
                                                         io::ExportContent content) {
    const io::RunReader run = samples::write_run(folder_ / "run", info, {snapshot});
    io::ExportOptions options;
    options.content = content;
    options.surface.resolution = 0.25;
    const auto files = io::export_run(run, std::vector<std::size_t>{0}, folder_ / "f.vdb", options);
    if (!files) throw std::runtime_error(files.error().text());
    openvdb::io::File file(files->front().string());
    file.open(/*delayLoad=*/false);
    std::map<std::string, openvdb::GridBase::Ptr> grids;
    const openvdb::GridPtrVecPtr read = file.getGrids();
    for (const auto& grid : *read) {
      EXPECT_EQ(grid->metaValue<std::int64_t>("step"), snapshot.step);
      EXPECT_EQ(grid->metaValue<double>("time"), snapshot.time);
      grids[grid->getName()] = grid;
    }
    EXPECT_EQ(samples::files_in(folder_.path()), (std::vector<std::string>{"f.vdb", "run"}));
    return grids;
  }

  const samples::TemporaryFolder folder_;
};

TEST_F(ExportVdb, PointsCarryWhatHoudiniWants) {
  const io::RunInfo info = samples::run_info();
  const Snapshot snapshot = samples::snapshot(8, 1000);
  const ParticleSet& p = snapshot.particles;
  const auto grids = exported(info, snapshot, io::ExportContent::particles);
  ASSERT_EQ(grids.size(), 1U);
  const auto grid = openvdb::gridPtrCast<points::PointDataGrid>(grids.at("particles"));
  EXPECT_EQ(grid->metaValue<std::string>("materials"), info.materials[0].name + "," + info.materials[1].name);

  std::size_t count = 0;
  for (auto leaf = grid->tree().cbeginLeaf(); leaf; ++leaf) {
    const points::AttributeHandle<openvdb::Vec3f> position(leaf->constAttributeArray("P"));
    const points::AttributeHandle<openvdb::Vec3f> velocity(leaf->constAttributeArray("v"));
    const points::AttributeHandle<std::int64_t> id(leaf->constAttributeArray("id"));
    const points::AttributeHandle<float> radius(leaf->constAttributeArray("pscale"));
    const points::AttributeHandle<std::int32_t> material(leaf->constAttributeArray("material"));
    for (auto at = leaf->beginIndexOn(); at; ++at, ++count) {
      const std::size_t i = p.find(static_cast<std::uint64_t>(id.get(*at)));
      ASSERT_LT(i, p.size());
      const openvdb::Vec3d x = grid->transform().indexToWorld(position.get(*at) + at.getCoord().asVec3d());
      const openvdb::Vec3f v = velocity.get(*at);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(x[axis], component(p.position[i], axis), 1e-5);
        EXPECT_EQ(v[axis], static_cast<float>(component(p.velocity[i], axis)));
      }
      EXPECT_EQ(radius.get(*at), static_cast<float>(info.materials[p.material[i]].radius));
      EXPECT_EQ(material.get(*at), p.material[i]);
    }
  }
  EXPECT_EQ(count, p.size());
}

TEST_F(ExportVdb, VolumeOfASphereIsItsFogLevelSetAndVelocity) {
  constexpr double kRadius = 0.4;
  const io::RunInfo info{
      "s", 0.005, Integrator::symplectic_euler, Precision::single_precision, {{"water", kRadius, 1}}};
  Snapshot snapshot{8, 0.04, {}};
  snapshot.particles.id = {5};
  snapshot.particles.material = {0};
  snapshot.particles.position = {{2.03, -1, 30}};
  snapshot.particles.velocity = {{3, 0, -1}};
  const openvdb::Vec3d centre(2.03, -1, 30);
  const auto grids = exported(info, snapshot, io::ExportContent::volume);
  ASSERT_EQ(grids.size(), 3U);

  const auto surface = openvdb::gridPtrCast<openvdb::FloatGrid>(grids.at("surface"));
  EXPECT_EQ(surface->getGridClass(), openvdb::GRID_LEVEL_SET);
  EXPECT_DOUBLE_EQ(surface->voxelSize()[0], 0.1);
  double volume = 0;
  for (auto voxel = surface->cbeginValueOn(); voxel; ++voxel) {
    const double distance = (surface->indexToWorld(voxel.getCoord()) - centre).length() - kRadius;
    EXPECT_NEAR(voxel.getValue(), distance, 0.05);
    EXPECT_LE(std::abs(voxel.getValue()), 0.3F + 1e-5F);
  }
  EXPECT_LT(surface->tree().getValue(surface->transform().worldToIndexNodeCentered(centre)), -0.2F);

  const auto density = openvdb::gridPtrCast<openvdb::FloatGrid>(grids.at("density"));
  EXPECT_EQ(density->getGridClass(), openvdb::GRID_FOG_VOLUME);
  for (auto voxel = density->cbeginValueOn(); voxel; ++voxel) {
    EXPECT_GE(voxel.getValue(), 0);
    EXPECT_LE(voxel.getValue(), 1);
    EXPECT_LT((density->indexToWorld(voxel.getCoord()) - centre).length(), kRadius + 0.05);
    volume += 0.001;
  }
  EXPECT_NEAR(volume / (4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius), 1, 0.1);
  EXPECT_EQ(density->tree().getValue(density->transform().worldToIndexNodeCentered(centre)), 1);

  const auto velocity = openvdb::gridPtrCast<openvdb::Vec3SGrid>(grids.at("vel"));
  EXPECT_DOUBLE_EQ(velocity->voxelSize()[0], kRadius);
  std::size_t near = 0;
  for (auto voxel = velocity->cbeginValueOn(); voxel; ++voxel, ++near) {
    EXPECT_TRUE(voxel.getValue().eq(openvdb::Vec3s(3, 0, -1), 1e-5F));
  }
  EXPECT_GE(near, 27U);  // a voxel around the sphere on every side
}

TEST_F(ExportVdb, OfNobodyHoldsEmptyGrids) {
  const Snapshot nobody{0, 0, {}};
  EXPECT_TRUE(exported(samples::run_info(), nobody, io::ExportContent::particles).at("particles")->empty());
  std::filesystem::remove_all(folder_.path());
  std::filesystem::create_directory(folder_.path());
  EXPECT_TRUE(exported(samples::run_info(), nobody, io::ExportContent::volume).at("density")->empty());
}

}  // namespace
}  // namespace hooke
