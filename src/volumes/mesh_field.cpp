// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/volumes/mesh_field.h"

#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "hooke/base/parallel.h"
#include "hooke/volumes/no_throw.h"
#include "hooke/volumes/openvdb_support.h"

namespace hooke::volumes {
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

  int first(std::size_t axis) const { return first_[axis]; }
  int count(std::size_t axis) const { return count_[axis]; }
  // The key of the brick that starts so many bricks before a leaf, along each axis.
  std::uint64_t key(const openvdb::Coord& leaf, int x, int y, int z) const {
    const auto place = [&](std::size_t axis, int back) { return floor_to_brick(leaf[axis]) - first_[axis] - back; };
    return brick_key(place(0, x), place(1, y), place(2, z));
  }
  openvdb::Coord origin(std::uint64_t key) const {
    constexpr unsigned kBits = DistanceFieldView::kKeyBits;
    const auto part = [&](std::size_t axis, unsigned shift) {
      return kCells * (first_[axis] + static_cast<int>(key >> shift & ((std::uint64_t{1} << kBits) - 1)));
    };
    return {part(0, 0), part(1, kBits), part(2, 2 * kBits)};
  }

 private:
  static int floor_to_brick(int index) { return index >= 0 ? index / kCells : -((kCells - 1 - index) / kCells); }

  int first_[3], count_[3];
};

// The bricks that hold a sample of a leaf, in ascending order.
std::vector<std::uint64_t> bricks_in_use(const openvdb::FloatGrid& grid, const BrickLayout& layout) {
  std::vector<std::uint64_t> used;
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    if (leaf->isEmpty()) continue;
    for (int corner = 0; corner < 8; ++corner) {
      used.push_back(layout.key(leaf->origin(), corner & 1, corner >> 1 & 1, corner >> 2));
    }
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

constexpr std::size_t kPerBrick = std::size_t{kSamples} * kSamples * kSamples;

// Copies the samples of bricks, in cells: leaf by leaf, since a look-up for each sample would take most of the time.
class BrickReader {
 public:
  explicit BrickReader(const openvdb::FloatGrid& grid) : values_(grid.getConstAccessor()) {}

  void read(const openvdb::Coord& origin, float* out) {
    for (int corner = 0; corner < 8; ++corner) {
      const int offset[3] = {kCells * (corner & 1), kCells * (corner >> 1 & 1), kCells * (corner >> 2)};
      const openvdb::Coord at = origin.offsetBy(offset[0], offset[1], offset[2]);
      const auto* leaf = values_.probeConstLeaf(at);
      const float everywhere = leaf == nullptr ? values_.getValue(at) : 0;
      int count[3];
      for (int axis = 0; axis < 3; ++axis) count[axis] = offset[axis] == 0 ? kCells : 1;
      for (int z = 0; z < count[2]; ++z) {
        for (int y = 0; y < count[1]; ++y) {
          float* row = out + ((offset[2] + z) * kSamples + offset[1] + y) * kSamples + offset[0];
          for (int x = 0; x < count[0]; ++x) row[x] = leaf == nullptr ? everywhere : leaf->getValue(number(x, y, z));
        }
      }
    }
  }

 private:
  // Of a value within a leaf, which has z fastest.
  static openvdb::Index number(int x, int y, int z) {
    return static_cast<openvdb::Index>((x * kCells + y) * kCells + z);
  }

  openvdb::FloatGrid::ConstAccessor values_;
};

// Keeps the bricks in which a distance may be needed: one of their samples is within a cell of the part of the band
// that the options ask for.
void drop_far_bricks(const openvdb::FloatGrid& grid, const BrickLayout& layout, const FieldOptions& options,
                     std::vector<std::uint64_t>& bricks) {
  const auto most = static_cast<float>(options.reach / options.cell + 1);
  const auto least = static_cast<float>(-options.depth * options.reach / options.cell - 1);
  std::vector<char> near(bricks.size());
  parallel_ranges(bricks.size(), 64, [&](std::size_t first, std::size_t last) {
    BrickReader reader(grid);
    std::array<float, kPerBrick> samples;
    for (std::size_t i = first; i < last; ++i) {
      reader.read(layout.origin(bricks[i]), samples.data());
      near[i] = std::any_of(samples.begin(), samples.end(), [&](float d) { return d <= most && d >= least; });
    }
  });
  std::size_t i = 0;
  std::erase_if(bricks, [&](std::uint64_t) { return near[i++] == 0; });
}

void fill_samples(const openvdb::FloatGrid& grid, const BrickLayout& layout, DistanceField& field) {
  field.samples.resize(field.keys.size() * kPerBrick);
  parallel_ranges(field.keys.size(), 16, [&](std::size_t first, std::size_t last) {
    BrickReader reader(grid);
    for (std::size_t brick = first; brick < last; ++brick) {
      float* const out = field.samples.data() + brick * kPerBrick;
      reader.read(layout.origin(field.keys[brick]), out);
      for (std::size_t i = 0; i < kPerBrick; ++i) {
        out[i] = static_cast<float>(field.cell * static_cast<double>(out[i]));
      }
    }
  });
}

DistanceField field_around(const TriangleMesh& mesh, const FieldOptions& options) {
  const CellMesh cells(mesh, options.cell);
  // Distances in cells; three more than asked for, so that all corners exist for a cell at that distance and for its
  // neighbours.
  const auto band = [&](double reaches) {
    return static_cast<float>(std::ceil(reaches * options.reach / options.cell) + 3);
  };
  const float outside = band(1), inside = options.closed ? band(options.depth) : outside;
  const int flags = options.closed ? 0 : openvdb::tools::UNSIGNED_DISTANCE_FIELD;
  const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
  const auto grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(cells, *transform, outside, inside, flags);
  const BrickLayout layout(*grid);
  DistanceField field;
  field.cell = options.cell;
  field.open = !options.closed;
  field.band = options.reach;
  field.origin = options.cell * kCells *
                 Vec3d{static_cast<double>(layout.first(0)), static_cast<double>(layout.first(1)),
                       static_cast<double>(layout.first(2))};
  field.bricks = {layout.count(0), layout.count(1), layout.count(2)};
  field.keys = bricks_in_use(*grid, layout);
  drop_far_bricks(*grid, layout, options, field.keys);
  field.make_directory();
  fill_samples(*grid, layout, field);
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
  if (!spans_few_cells(mesh, options)) return fail(Error::Kind::bad_input, "", "spans too many cells");
  return no_throw([&]() -> Expected<DistanceField> { return field_around(mesh, options); });
}

}  // namespace hooke::volumes
