// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>

#include "hooke/base/box3.h"
#include "hooke/volumes/mesh_field.h"

namespace hooke::volumes {
namespace {

constexpr int kCells = DistanceFieldView::kCells, kSamples = DistanceFieldView::kSamples;
constexpr double kPerBrick = double{kSamples} * kSamples * kSamples;

// Half the thickness of the band around the surface that has samples, in cells.
double half_band(const FieldOptions& options) {
  return 0.5 * (1 + (options.closed ? options.depth : 1)) * options.reach / options.cell + 1;
}

// Counts the bricks that a band around triangles meets. Triangles, in cells, are cut into small ones, and those stand
// for the boxes around them: work and memory go with the surface, also with the length of one without area.
class BrickCounter {
 public:
  BrickCounter(double half_band, double most)
      : band_(half_band),
        piece_(std::max(double{kCells}, half_band)),
        most_(most) {}

  bool is_full() const { return static_cast<double>(bricks_.size()) > most_; }
  double count() const { return static_cast<double>(bricks_.size()); }

  void add(const std::array<Vec3d, 3>& t) {
    if (is_full()) return;
    std::size_t longest = 0;
    double length2 = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d edge = t[(k + 1) % 3] - t[k];
      if (dot(edge, edge) > length2) {
        length2 = dot(edge, edge);
        longest = k;
      }
    }
    if (length2 <= piece_ * piece_) return add_piece(t);
    const Vec3d &a = t[longest], &b = t[(longest + 1) % 3], &c = t[(longest + 2) % 3];
    const Vec3d middle = 0.5 * (a + b);
    add({a, middle, c});
    add({middle, b, c});
  }

 private:
  using Range = std::array<std::int64_t, 6>;

  void add_piece(const std::array<Vec3d, 3>& t) {
    Range range;
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax({component(t[0], axis), component(t[1], axis), component(t[2], axis)});
      const auto at = static_cast<std::size_t>(axis);
      range[at] = static_cast<std::int64_t>(std::floor((low - band_) / kCells));
      range[at + 3] = static_cast<std::int64_t>(std::floor((high + band_) / kCells));
    }
    if (range == last_) return;  // small triangles follow their neighbours
    last_ = range;
    for (std::int64_t z = range[2]; z <= range[5]; ++z) {
      for (std::int64_t y = range[1]; y <= range[4]; ++y) {
        for (std::int64_t x = range[0]; x <= range[3]; ++x) bricks_.insert(key(x) << 42U | key(y) << 21U | key(z));
      }
    }
  }

  static std::uint64_t key(std::int64_t brick) { return static_cast<std::uint64_t>(brick) & ((1U << 21U) - 1); }

  double band_, piece_, most_;
  Range last_{1, 1, 1, 0, 0, 0};
  std::unordered_set<std::uint64_t> bricks_;
};

}  // namespace

bool spans_few_cells(const TriangleMesh& mesh, const FieldOptions& options) {
  // With room for the band on both sides.
  const double most = double{DistanceFieldView::kMostBricks} * kCells, band = 2 * half_band(options) + 4 * kCells;
  Box3d box = Box3d::none();
  for (const Vec3d& x : mesh.vertices) {
    if (!std::isfinite(x.x) || !std::isfinite(x.y) || !std::isfinite(x.z)) return false;
    box.add(x);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double low = component(box.min, axis), high = component(box.max, axis);
    // OpenVDB numbers cells from 0 with 32 bits.
    const double farthest = std::max(std::abs(low), std::abs(high)) / options.cell + 2 * band;
    if (!((high - low) / options.cell + 2 * band <= most && farthest < 2e9)) return false;
  }
  return true;
}

double expected_samples(const TriangleMesh& mesh, const FieldOptions& options, double most) {
  const double cell = options.cell, band = half_band(options);
  double area = 0;  // in cells
  for (const auto& t : mesh.triangles) {
    const Vec3d n = cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    area += 0.5 * std::sqrt(dot(n, n)) / (cell * cell);
  }
  // Surfaces that lie close together share bricks, but not so many of them.
  constexpr double kShared = 8;
  const double by_area = area * (2 * band + kCells);
  if (!(by_area <= kShared * most)) return by_area;
  BrickCounter bricks(band, most / kPerBrick);
  for (const auto& t : mesh.triangles) {
    std::array<Vec3d, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = (1 / cell) * mesh.vertices[t[k]];
    bricks.add(corners);
    if (bricks.is_full()) return std::max(by_area, kPerBrick * bricks.count());
  }
  return kPerBrick * bricks.count();
}

}  // namespace hooke::volumes
