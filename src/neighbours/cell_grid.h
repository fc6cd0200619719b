// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/base/vec3.h"
#include "hooke/neighbours/window_search.h"

namespace hooke {

/// A uniform grid over the box around the points, and the order of the points by cell (the thesis's Algorithm 3). Cells
/// are numbered along x first, so the cells x-1, x, x+1 of a row are one range of numbers and, after the sort, one
/// range of points. There is no table of cells: a sparse cloud in a domain of a million cells per axis needs no more
/// memory than a dense one.
class CellGrid {
 public:
  /// One axis of the grid.
  struct Axis {
    double origin = 0;  // m, lower edge of the first cell
    double cell = 1;  // m, edge of a cell
    double length = 1;  // m, of the box
    std::int64_t count = 1;  // cells
    bool periodic = false;
  };

  static constexpr std::int64_t kMaxCells = 1 << 20;  ///< per axis; beyond that cells grow

  /// Lays the grid over the box [min, max] (m, finite, min no greater than max) with cells no smaller than `reach` (m,
  /// > 0): points closer than that are in the same or in adjacent cells. A periodic axis must cover its whole period,
  /// min to max.
  void lay_out(const Vec3d& min, const Vec3d& max, const bool (&periodic)[3], double reach) {
    lay_out(min, max, periodic, Vec3d{reach, reach, reach});
  }
  /// The same with one reach per axis.
  void lay_out(const Vec3d& min, const Vec3d& max, const bool (&periodic)[3], const Vec3d& reach);

  /// Number of the cell of a finite point; a point outside the box counts to a cell at its edge.
  std::uint64_t key_of(const Vec3d& x) const {
    HOOKE_ASSERT(is_finite(x), x);
    return static_cast<std::uint64_t>(index_of(x.x, 0) + stride_y_ * index_of(x.y, 1) + stride_z_ * index_of(x.z, 2));
  }

  /// key_of() of the points first to last - 1, in a grid of less than 2^32 cells. Plain loops that compilers vectorise.
  template <class Real>
  void keys_of(const Columns<Real>& points, std::size_t first, std::size_t last, std::uint32_t* keys) const {
    HOOKE_ASSERT(first <= last, first, last);
    HOOKE_ASSERT(key_end() <= std::uint64_t{1} << 32U, key_end());
    std::fill(keys, keys + (last - first), 0U);
    const Real* const columns[] = {points.x + first, points.y + first, points.z + first};
    const std::int64_t strides[] = {1, stride_y_, stride_z_};
    for (int axis = 0; axis < 3; ++axis) {
      const Real* const column = columns[axis];
      const auto stride = static_cast<std::uint32_t>(strides[axis]);
      const double origin = axes_[axis].origin, inverse = inverse_cell_[axis], end = last_cell_[axis];
      for (std::size_t i = 0; i < last - first; ++i) {
        const double cell = (static_cast<double>(column[i]) - origin) * inverse;
        const double inside = cell > 0 ? cell : 0;
        keys[i] += stride * static_cast<std::uint32_t>(static_cast<std::int32_t>(inside < end ? inside : end) + 1);
      }
    }
  }

  /// The same, numbered along a path: rows along one axis, side by side in layers; every other row and every other
  /// layer runs backwards, so that cells with consecutive numbers are adjacent. Layers are perpendicular to the longest
  /// axis, so they are as small as possible, and adjacent layers are close in memory.
  std::uint64_t path_key_of(const Vec3d& x) const {
    HOOKE_ASSERT(is_finite(x), x);
    const auto index = [&](int axis) { return index_of(component(x, axis), axis); };
    const Row row = row_at(index(path_[1]), index(path_[2]));
    return static_cast<std::uint64_t>(row.start + mirrored(index(path_[0]), path_[0], row.backwards));
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

  /// One past the largest key: the key of points that take no part; they are sorted last.
  std::uint64_t key_end() const { return static_cast<std::uint64_t>(stride_z_ * (axes_[2].count + 2)); }

  /// Inclusive range of cell numbers.
  struct KeyRange {
    std::uint64_t first, last;
  };
  /// The cells adjacent to `key` (< key_end()) and to up to `more` (>= 0) cells after it in its row, including these
  /// cells themselves, as disjoint ranges of numbers; each cell appears once. At most nine rows, each cut in two where
  /// x is periodic.
  static constexpr std::size_t kMostRanges = 18;
  std::size_t neighbour_ranges(std::uint64_t key, KeyRange (&out)[kMostRanges], int more = 0) const;

  /// Calls body(range) for disjoint ranges of numbers along the path, in no order; together they hold each cell that
  /// the box [min, max] meets, also around periodic axes, exactly once.
  template <class Body>
  void for_path_ranges(const Vec3d& min, const Vec3d& max, const Body& body) const {
    Stretches along[3];
    for (std::size_t k = 0; k < 3; ++k) {
      along[k] = stretches(path_[k], component(min, path_[k]), component(max, path_[k]));
    }
    const std::int64_t end = axes_[path_[0]].count + 1;
    for (int sl = 0; sl < along[2].count; ++sl) {
      for (std::int64_t layer = along[2].of[sl].first; layer <= along[2].of[sl].last; ++layer) {
        for (int sr = 0; sr < along[1].count; ++sr) {
          for (std::int64_t r = along[1].of[sr].first; r <= along[1].of[sr].last; ++r) {
            const Row row = row_at(r, layer);
            for (int s = 0; s < along[0].count; ++s) {
              auto [first, last] = along[0].of[s];
              if (row.backwards) std::tie(first, last) = std::pair(end - last, end - first);
              body(KeyRange{static_cast<std::uint64_t>(row.start + first),
                            static_cast<std::uint64_t>(row.start + last)});
            }
          }
        }
      }
    }
  }

  const Axis& axis(int i) const { return axes_[i]; }
  /// The axes of the path.
  const std::array<int, 3>& path() const { return path_; }

 private:
  static bool is_finite(const Vec3d& x) { return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z); }

  std::int64_t index_of(double x, int i) const {
    const double cell = (x - axes_[i].origin) * inverse_cell_[i];
    // Clamped before the conversion, which is undefined for values beyond int64.
    const double inside = cell > 0 ? cell : 0;
    return static_cast<std::int64_t>(inside < last_cell_[i] ? inside : last_cell_[i]) + 1;
  }

  // A row of cells on the path.
  struct Row {
    std::int64_t start;  // the key before the row's first
    bool backwards;
  };
  Row row_at(std::int64_t row, std::int64_t layer) const {
    const std::int64_t rows = axes_[path_[1]].count, stride = axes_[path_[0]].count + 2;
    const std::int64_t on_path = mirrored(row, path_[1], (layer & 1) != 0);
    return {(layer * (rows + 2) + on_path) * stride, (((layer & rows) ^ on_path) & 1) != 0};
  }
  // The index counted from the other end, if `yes`. Without a branch, which could not be predicted.
  std::int64_t mirrored(std::int64_t index, int axis, bool yes) const {
    return index + static_cast<std::int64_t>(yes) * (axes_[axis].count + 1 - 2 * index);
  }

  // Indices first to last of an axis as one stretch, or as two where they wrap around a periodic axis.
  struct Stretches {
    struct {
      std::int64_t first, last;
    } of[2];
    int count;
  };
  Stretches stretches(int i, double min, double max) const {
    const Axis& a = axes_[i];
    const double end = a.origin + a.length;
    if (!a.periodic || (min >= a.origin && max < end)) return {{{index_of(min, i), index_of(max, i)}, {}}, 1};
    if (!(max - min < a.length)) return {{{1, a.count}, {}}, 1};
    const double before = std::floor((min - a.origin) / a.length) * a.length;
    const std::int64_t first = index_of(min - before, i);
    if (max - before < end) return {{{first, index_of(max - before, i)}, {}}, 1};
    const std::int64_t last = index_of(max - before - a.length, i);
    if (last >= first) return {{{1, a.count}, {}}, 1};
    return {{{first, a.count}, {1, last}}, 2};
  }

  Axis axes_[3];
  double inverse_cell_[3] = {1, 1, 1};
  double last_cell_[3] = {0, 0, 0};  // number of cells less one
  std::array<int, 3> path_{0, 1, 2};  // axes
  std::int64_t stride_y_ = 3, stride_z_ = 9;  // with one empty cell at both ends of every axis
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
