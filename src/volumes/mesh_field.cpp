// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/volumes/mesh_field.h"

#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hooke/base/parallel.h"
#include "hooke/physics/enclosure.h"
#include "hooke/volumes/no_throw.h"
#include "hooke/volumes/openvdb_support.h"

namespace hooke {
namespace {

constexpr int kCells = DistanceFieldView::kCells, kSamples = DistanceFieldView::kSamples;

// The mesh in the interface that OpenVDB expects, in units of cells.
class CellMesh {
 public:
  CellMesh(const TriangleMesh& mesh, double cell) : mesh_(mesh), per_cell_(1 / cell) {}

  std::size_t polygonCount() const { return mesh_.triangles.size(); }
  std::size_t pointCount() const { return mesh_.vertices.size(); }
  std::size_t vertexCount(std::size_t) const { return 3; }
  void getIndexSpacePoint(std::size_t triangle, std::size_t corner, openvdb::Vec3d& place) const {
    const Vec3d& x = mesh_.vertices[mesh_.triangles[triangle][corner]];
    place = openvdb::Vec3d(per_cell_ * x.x, per_cell_ * x.y, per_cell_ * x.z);
  }

 private:
  const TriangleMesh& mesh_;
  double per_cell_;
};

// Bricks coincide with the leaves of the grid; a leaf's first samples are also the last ones of the brick before.
class BrickLayout {
 public:
  explicit BrickLayout(const openvdb::FloatGrid& grid) {
    const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      first_[axis] = floor_to_brick(box.min()[axis]) - 1;
      count_[axis] = floor_to_brick(box.max()[axis]) - first_[axis] + 1;
    }
  }

  static int floor_to_brick(int index) { return index >= 0 ? index / kCells : -((kCells - 1 - index) / kCells); }

  int first(std::size_t axis) const { return first_[axis]; }
  int count(std::size_t axis) const { return count_[axis]; }
  std::size_t size() const {
    return static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
           static_cast<std::size_t>(count_[2]);
  }
  std::size_t at(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(count_[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(count_[0]) +
           static_cast<std::size_t>(x);
  }
  openvdb::Coord origin(std::size_t brick) const {
    const auto columns = static_cast<std::size_t>(count_[0]), rows = static_cast<std::size_t>(count_[1]);
    return {kCells * (first_[0] + static_cast<int>(brick % columns)),
            kCells * (first_[1] + static_cast<int>(brick / columns % rows)),
            kCells * (first_[2] + static_cast<int>(brick / columns / rows))};
  }

 private:
  int first_[3], count_[3];
};

// The bricks that hold a sample of a leaf, in ascending order.
std::vector<std::size_t> bricks_in_use(const openvdb::FloatGrid& grid, const BrickLayout& layout) {
  std::vector<std::size_t> used;
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    if (leaf->isEmpty()) continue;
    const openvdb::Coord at = leaf->origin();
    for (int corner = 0; corner < 8; ++corner) {
      const int b[3] = {BrickLayout::floor_to_brick(at[0]) - layout.first(0) - (corner & 1),
                        BrickLayout::floor_to_brick(at[1]) - layout.first(1) - (corner >> 1 & 1),
                        BrickLayout::floor_to_brick(at[2]) - layout.first(2) - (corner >> 2)};
      used.push_back(layout.at(b[0], b[1], b[2]));
    }
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

// Marks bricks without samples that lie inside the mesh.
void mark_inside(const openvdb::FloatGrid& grid, const BrickLayout& layout, std::vector<std::int32_t>& directory) {
  parallel_ranges(directory.size(), 256, [&](std::size_t first, std::size_t last) {
    const auto values = grid.getConstAccessor();
    for (std::size_t brick = first; brick < last; ++brick) {
      const bool empty = directory[brick] == DistanceFieldView::kNothing;
      if (empty && values.getValue(layout.origin(brick)) < 0) directory[brick] = kBrickInside;
    }
  });
}

void fill_samples(const openvdb::FloatGrid& grid, const BrickLayout& layout, const std::vector<std::size_t>& used,
                  double cell, std::vector<float>& samples) {
  constexpr std::size_t kPerBrick = std::size_t{kSamples} * kSamples * kSamples;
  samples.resize(used.size() * kPerBrick);
  parallel_ranges(used.size(), 16, [&](std::size_t first, std::size_t last) {
    const auto values = grid.getConstAccessor();
    for (std::size_t brick = first; brick < last; ++brick) {
      const openvdb::Coord origin = layout.origin(used[brick]);
      float* out = samples.data() + brick * kPerBrick;
      for (int z = 0; z < kSamples; ++z) {
        for (int y = 0; y < kSamples; ++y) {
          for (int x = 0; x < kSamples; ++x) {
            *out++ = static_cast<float>(cell * static_cast<double>(values.getValue(origin.offsetBy(x, y, z))));
          }
        }
      }
    }
  });
}

DistanceField field_around(const TriangleMesh& mesh, const FieldOptions& options) {
  const CellMesh cells(mesh, options.cell);
  // Distances in cells; three more than asked for, so that all corners exist for a cell at that distance and for its
  // neighbours.
  const auto outside = static_cast<float>(std::ceil(options.reach / options.cell) + 3);
  const float inside = options.closed ? 3 * outside : outside;
  const int flags = options.closed ? 0 : openvdb::tools::UNSIGNED_DISTANCE_FIELD;
  const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
  const auto grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(cells, *transform, outside, inside, flags);
  const BrickLayout layout(*grid);
  DistanceField field;
  field.cell = options.cell;
  field.open = !options.closed;
  field.band = options.cell * static_cast<double>(outside);
  field.origin = options.cell * kCells *
                 Vec3d{static_cast<double>(layout.first(0)), static_cast<double>(layout.first(1)),
                       static_cast<double>(layout.first(2))};
  field.bricks = {layout.count(0), layout.count(1), layout.count(2)};
  const std::vector<std::size_t> used = bricks_in_use(*grid, layout);
  field.directory.assign(layout.size(), DistanceFieldView::kNothing);
  for (std::size_t i = 0; i < used.size(); ++i) field.directory[used[i]] = static_cast<std::int32_t>(i);
  if (options.closed) mark_inside(*grid, layout, field.directory);
  fill_samples(*grid, layout, used, options.cell, field.samples);
  field.min = field.max = mesh.vertices.front();
  for (const Vec3d& x : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      component(field.min, axis) = std::min(component(field.min, axis), component(x, axis));
      component(field.max, axis) = std::max(component(field.max, axis), component(x, axis));
    }
  }
  return field;
}

}  // namespace

bool has_openvdb() { return true; }

Expected<DistanceField> make_distance_field(const TriangleMesh& mesh, const FieldOptions& options) {
  return no_throw([&]() -> Expected<DistanceField> { return field_around(mesh, options); });
}

}  // namespace hooke
