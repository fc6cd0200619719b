// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/base/vec3.h"
#include "hooke/neighbours/grid_geometry.h"
#include "hooke/neighbours/window_search.h"

namespace hooke {

/// A uniform grid over the box around the points, and the order of the points by cell (the thesis's Algorithm 3). Cells
/// are numbered along x first, so the cells x-1, x, x+1 of a row are one range of numbers and, after the sort, one
/// range of points. There is no table of cells: a sparse cloud in a domain of a million cells per axis needs no more
/// memory than a dense one.
class CellGrid : private GridGeometry {
 public:
  using GridGeometry::Axis;
  using GridGeometry::for_path_ranges;
  using GridGeometry::key_end;
  using GridGeometry::KeyRange;

  static constexpr std::int64_t kMaxCells = 1 << 20;  ///< per axis; beyond that cells grow

  /// Lays the grid over the box [min, max] (m, finite, min no greater than max) with cells no smaller than `reach` (m,
  /// > 0): points closer than that are in the same or in adjacent cells. A periodic axis must cover its whole period,
  /// min to max.
  void lay_out(const Vec3d& min, const Vec3d& max, const bool (&periodic)[3], double reach) {
    lay_out(min, max, periodic, Vec3d{reach, reach, reach});
  }
  /// The same with one reach per axis.
  void lay_out(const Vec3d& min, const Vec3d& max, const bool (&periodic)[3], const Vec3d& reach);

  /// Plain numbers, to ask on a device.
  const GridGeometry& geometry() const { return *this; }

  /// As of GridGeometry; the point is finite.
  std::uint64_t key_of(const Vec3d& x) const {
    HOOKE_ASSERT(is_finite(x), x);
    return GridGeometry::key_of(x);
  }
  std::uint64_t path_key_of(const Vec3d& x) const {
    HOOKE_ASSERT(is_finite(x), x);
    return GridGeometry::path_key_of(x);
  }

  /// key_of() of the points first to last - 1, in a grid of less than 2^32 cells. Plain loops that compilers vectorise.
  template <class Real>
  void keys_of(const Vec3Columns<Real>& points, std::size_t first, std::size_t last, std::uint32_t* keys) const {
    HOOKE_ASSERT(first <= last, first, last);
    HOOKE_ASSERT(key_end() <= std::uint64_t{1} << 32U, key_end());
    std::fill(keys, keys + (last - first), 0U);
    const Real* const columns[] = {points.x + first, points.y + first, points.z + first};
    const std::int64_t strides[] = {1, stride_y, stride_z};
    for (int a = 0; a < 3; ++a) {
      const Real* const column = columns[a];
      const auto stride = static_cast<std::uint32_t>(strides[a]);
      const double origin = axes[a].origin, inverse = inverse_cell[a], end = last_cell[a];
      for (std::size_t i = 0; i < last - first; ++i) {
        const double cell = (static_cast<double>(column[i]) - origin) * inverse;
        const double inside = cell > 0 ? cell : 0;
        keys[i] += stride * static_cast<std::uint32_t>(static_cast<std::int32_t>(inside < end ? inside : end) + 1);
      }
    }
  }

  /// The axes of the path through the box [min, max]: along rows, across the rows of a layer, across layers.
  static std::array<int, 3> path_axes(const Vec3d& min, const Vec3d& max) {
    std::array<int, 3> axes{0, 1, 2};
    const Vec3d length = max - min;
    std::sort(axes.begin(), axes.end(), [&](int a, int b) {
      const double of_a = component(length, a), of_b = component(length, b);
      return of_a != of_b ? of_a > of_b : a < b;
    });
    return {axes[1], axes[2], axes[0]};
  }

  /// The cells adjacent to `key` (< key_end()) and to up to `more` (>= 0) cells after it in its row, including these
  /// cells themselves, as disjoint ranges of numbers; each cell appears once. At most nine rows, each cut in two where
  /// x is periodic.
  static constexpr std::size_t kMostRanges = 18;
  std::size_t neighbour_ranges(std::uint64_t key, KeyRange (&out)[kMostRanges], int more = 0) const;

  const Axis& axis(int i) const { return axes[i]; }
  /// The axes of the path.
  std::array<int, 3> path() const { return {GridGeometry::path[0], GridGeometry::path[1], GridGeometry::path[2]}; }

 private:
  static bool is_finite(const Vec3d& x) { return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z); }
};

/// Finds the first point at or after a key. Cells are visited in ascending order, so the answer is usually a few points
/// after the last one. Each range around a cell has its own cursor.
class KeyCursor {
 public:
  /// Index into the ascending `keys`, which must be the same in every call; keys.size() if all keys are less.
  std::size_t seek(std::span<const std::uint64_t> keys, std::uint64_t key) {
    HOOKE_ASSERT(at_ <= keys.size(), at_, keys.size());
    constexpr std::size_t kFew = 16;
    if (at_ > 0 && keys[at_ - 1] >= key) {
      at_ = static_cast<std::size_t>(std::lower_bound(keys.begin(), keys.begin() + at(), key) - keys.begin());
      return at_;
    }
    // Counted, not searched: the distance is unpredictable, and a wrong guess costs more than a dozen comparisons.
    for (int tries = 0; tries < 3 && at_ + kFew <= keys.size(); ++tries) {
      std::size_t less = 0;
      for (std::size_t k = 0; k < kFew; ++k) less += keys[at_ + k] < key ? 1 : 0;
      at_ += less;
      if (less < kFew) return at_;
    }
    at_ = static_cast<std::size_t>(std::lower_bound(keys.begin() + at(), keys.end(), key) - keys.begin());
    return at_;
  }

 private:
  std::ptrdiff_t at() const { return static_cast<std::ptrdiff_t>(at_); }

  std::size_t at_ = 0;
};

/// Sorts up to 2^32 points by key, stably: then `keys` ascend, and `order[k]` is the previous index of the k-th point.
/// Parallel radix sort. Works in `scratch` where that is aligned to 8 bytes and holds 12 bytes per key; else in its own
/// memory.
void sort_by_key(std::vector<std::uint64_t>& keys, std::vector<std::uint32_t>& order,
                 std::span<std::byte> scratch = {});

}  // namespace hooke
