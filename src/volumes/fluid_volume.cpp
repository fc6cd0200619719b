// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/volumes/fluid_volume.h"

#include <fmt/format.h>
#include <openvdb/tools/ChangeBackground.h>
#include <openvdb/tools/FastSweeping.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/Prune.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tree/LeafManager.h>

#include <cmath>
#include <numeric>

#include "hooke/volumes/field_blocks.h"

namespace hooke::volumes {

namespace {

constexpr float kBand = 3;  // voxels, half-width of a level set

std::string out_of_range(const SurfaceOptions& options) {
  const auto unless = [](const char* name, double value, double min, double max) {
    if (value >= min && value <= max) return std::string();
    return fmt::format("can't draw a surface: {} {} is not from {} to {}", name, value, min, max);
  };
  std::string wrong = unless("radius", options.radius, 0.1, 10);
  if (wrong.empty()) wrong = unless("resolution", options.resolution, 0.1, options.radius);
  if (wrong.empty()) wrong = unless("smoothing", options.smoothing, options.resolution, 10);
  return wrong;
}

openvdb::Coord corner(const FieldBlocks::Coordinates& at) {
  return {at[0] * FieldBlocks::kEdge, at[1] * FieldBlocks::kEdge, at[2] * FieldBlocks::kEdge};
}

// The blocks that the surface passes through or between, and their neighbours.
std::vector<std::size_t> surface_blocks(const FieldBlocks& blocks, float threshold) {
  enum Side : std::uint8_t { outside = 1, inside = 2, both = 3 };
  std::vector<std::uint8_t> side(blocks.size());
  std::vector<std::size_t> all(blocks.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  blocks.sum<0>(all, {}, [&](std::size_t b, const FieldBlocks::Sums<0>& sums) {
    unsigned found = 0;
    for (const float weight : sums.weight) found |= unsigned{weight > threshold ? inside : outside};
    side[b] = static_cast<std::uint8_t>(found);
  });

  const auto with_neighbours = [&](std::size_t b, const auto& visit) {  // a missing block is outside
    const FieldBlocks::Coordinates at = blocks.coordinates(b);
    for (std::int32_t x = -1; x <= 1; ++x) {
      for (std::int32_t y = -1; y <= 1; ++y) {
        for (std::int32_t z = -1; z <= 1; ++z) visit(blocks.find({at[0] + x, at[1] + y, at[2] + z}));
      }
    }
  };
  std::vector<std::uint8_t> chosen(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (side[b] == outside) continue;  // its neighbours with voxels inside take care of it
    unsigned around = 0;
    with_neighbours(b, [&](std::optional<std::size_t> n) { around |= n ? side[*n] : std::uint8_t{outside}; });
    if (around != both) continue;
    with_neighbours(b, [&](std::optional<std::size_t> n) {
      if (n) chosen[*n] = 1;
    });
  }
  std::erase_if(all, [&](std::size_t b) { return chosen[b] == 0; });
  return all;
}

}  // namespace

Expected<FluidVolume> FluidVolume::create(const ParticleSet& particles, std::span<const double> radius,
                                          const SurfaceOptions& options) {
  openvdb::initialize();
  const auto refuse = [](std::string why) { return fail(Error::Kind::bad_input, "", std::move(why)); };
  if (std::string wrong = out_of_range(options); !wrong.empty()) return refuse(std::move(wrong));
  FluidVolume fluid(particles);
  fluid.smallest_ = std::numeric_limits<double>::max();
  for (const std::uint16_t m : particles.material) fluid.smallest_ = std::min(fluid.smallest_, radius[m]);
  if (particles.empty()) fluid.smallest_ = 1;
  fluid.voxel_ = options.resolution * fluid.smallest_;
  fluid.reach_ratio_ = (options.radius + options.smoothing) / options.radius;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (!FieldBlocks::block_at(particles.position[i], fluid.voxel_)) {
      return refuse(fmt::format("particle {} is more than {} voxels from the origin: too far for a grid",
                                particles.id[i], FieldBlocks::kMaxBlock * FieldBlocks::kEdge));
    }
    const double sphere = options.radius * radius[particles.material[i]];
    fluid.sphere_.push_back({static_cast<float>(sphere)});
    fluid.reach_.push_back(sphere * fluid.reach_ratio_);
    if (fluid.reach_.back() > 32 * FieldBlocks::kEdge * fluid.voxel_) {
      return refuse("can't draw a surface: the largest particle is too many voxels wide at this resolution");
    }
  }
  return fluid;
}

// The weight of a lone particle is w(d) = (1 - d^2 / reach^2)^3, and d - R is the distance to its sphere. So the sum S
// of all weights stands for one particle at the distance w^-1(S), with the weighted mean of R. The surface is where S =
// w(R): for one particle exactly its sphere, and a smooth skin around many (soft objects: Wyvill, McPheeters, Wyvill,
// "Data structure for soft objects", The Visual Computer 2, 1986).
openvdb::FloatGrid::Ptr FluidVolume::surface_field() const {
  const auto ratio = static_cast<float>(reach_ratio_);
  const float at_surface = 1 - 1 / (ratio * ratio);
  const float background = kBand * static_cast<float>(voxel_);
  auto grid = openvdb::createLevelSet<openvdb::FloatGrid>(voxel_, kBand);
  const FieldBlocks blocks(particles_.position, reach_, voxel_);
  const std::vector<std::size_t> chosen = surface_blocks(blocks, at_surface * at_surface * at_surface);

  std::vector<openvdb::FloatTree::LeafNodeType*> leaf(blocks.size());
  for (const std::size_t b : chosen) leaf[b] = grid->tree().touchLeaf(corner(blocks.coordinates(b)));
  blocks.sum<1>(chosen, sphere_, [&](std::size_t b, const FieldBlocks::Sums<1>& sums) {
    for (std::size_t v = 0; v < FieldBlocks::kVoxels; ++v) {
      const float weight = sums.weight[v];
      const float squared = 1 - std::cbrt(weight);  // (d / reach)^2, below 0 where particles are crowded
      const float distance = squared > 0 ? ratio * std::sqrt(squared) : 0;
      const float radius = weight > 0 ? sums.value[0][v] / weight : background;
      leaf[b]->setValueOn(static_cast<openvdb::Index>(v), weight > 0 ? radius * (distance - 1) : background);
    }
  });
  openvdb::tools::signedFloodFill(grid->tree());
  return grid;
}

openvdb::FloatGrid::Ptr FluidVolume::level_set() const {
  const openvdb::FloatGrid::Ptr field = surface_field();
  if (field->empty()) return field;
  const auto band = openvdb::tools::extractIsosurfaceMask(*field, 0.0);
  openvdb::tools::dilateActiveValues(band->tree(), static_cast<int>(kBand));
  field->topologyIntersection(*band);
  openvdb::FloatGrid::Ptr grid = openvdb::tools::sdfToSdf(*field);

  // Voxels beyond the band become background.
  const float background = kBand * static_cast<float>(voxel_);
  openvdb::tree::LeafManager<openvdb::FloatTree> leaves(grid->tree());
  leaves.foreach ([background](openvdb::FloatTree::LeafNodeType& leaf, std::size_t) {
    for (openvdb::Index v = 0; v < FieldBlocks::kVoxels; ++v) {
      const float distance = leaf.getValue(v);
      if (leaf.isValueOn(v) && std::abs(distance) < background) continue;
      leaf.setValueOff(v, distance < 0 ? -background : background);
    }
  });
  openvdb::tools::changeLevelSetBackground(grid->tree(), background);
  openvdb::tools::pruneLevelSet(grid->tree());
  return grid;
}

openvdb::FloatGrid::Ptr FluidVolume::fog(const openvdb::FloatGrid& level_set) {
  openvdb::FloatGrid::Ptr grid = level_set.deepCopy();
  openvdb::tools::sdfToFogVolume(*grid);
  return grid;
}

openvdb::Vec3SGrid::Ptr FluidVolume::velocity() const {
  auto grid = openvdb::Vec3SGrid::create();
  const double voxel = std::max(smallest_, voxel_);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
  grid->setVectorType(openvdb::VEC_CONTRAVARIANT_RELATIVE);

  std::vector<double> reach(reach_);  // at least one voxel beyond the surface
  for (double& r : reach) r = std::max(r, r / reach_ratio_ + 2 * voxel);
  std::vector<std::array<float, 3>> velocity;
  velocity.reserve(particles_.size());
  for (const Vec3d& v : particles_.velocity) {
    velocity.push_back({static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
  }
  const FieldBlocks blocks(particles_.position, reach, voxel);
  std::vector<std::size_t> all(blocks.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<openvdb::Vec3STree::LeafNodeType*> leaf;
  for (const std::size_t b : all) leaf.push_back(grid->tree().touchLeaf(corner(blocks.coordinates(b))));
  blocks.sum<3>(all, velocity, [&](std::size_t b, const FieldBlocks::Sums<3>& sums) {
    for (std::size_t v = 0; v < FieldBlocks::kVoxels; ++v) {
      const float weight = sums.weight[v];
      if (weight <= 0) continue;
      leaf[b]->setValueOn(static_cast<openvdb::Index>(v),
                          openvdb::Vec3s(sums.value[0][v], sums.value[1][v], sums.value[2][v]) / weight);
    }
  });
  openvdb::tools::pruneInactive(grid->tree());
  return grid;
}

}  // namespace hooke::volumes
