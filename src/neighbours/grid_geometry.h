// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

#include "hooke/base/real.h"
#include "hooke/base/vec3.h"

namespace hooke {

/// A uniform grid over a box: which cell a point is in, and which cells a box meets. Plain numbers, whose questions a
/// host and a device can ask; CellGrid lays it out. There are two ways to number cells, both with an empty cell at
/// either end of each axis: along x first, and along a path.
struct GridGeometry {
  /// One axis of the grid.
  struct Axis {
    double origin = 0;       // m, lower edge of the first cell
    double cell = 1;         // m, edge of a cell
    double length = 1;       // m, of the box
    std::int64_t count = 1;  // cells
    bool periodic = false;
  };
  /// Inclusive range of cell numbers.
  struct KeyRange {
    std::uint64_t first, last;
  };

  /// Inclusive range of indices along an axis.
  struct Stretch {
    std::int64_t first, last;
  };

  /// Number of the cell of a finite point; a point outside the box counts to a cell at its edge.
  HOOKE_HD std::uint64_t key_of(const Vec3d& x) const {
    return static_cast<std::uint64_t>(index_of(x.x, 0) + stride_y * index_of(x.y, 1) + stride_z * index_of(x.z, 2));
  }

  /// The same, numbered along a path: rows along one axis, side by side in layers; every other row and every other
  /// layer runs backwards, so that cells with consecutive numbers are adjacent. Layers are perpendicular to the longest
  /// axis, so they are as small as possible, and adjacent layers are close in memory.
  HOOKE_HD std::uint64_t path_key_of(const Vec3d& x) const {
    const auto index = [&](int axis) { return index_of(component(x, axis), axis); };
    const Row row = row_at(index(path[1]), index(path[2]));
    return static_cast<std::uint64_t>(row.start + mirrored(index(path[0]), path[0], row.backwards));
  }

  /// One past the largest key: the key of points that take no part; they are sorted last.
  HOOKE_HD std::uint64_t key_end() const { return static_cast<std::uint64_t>(stride_z * (axes[2].count + 2)); }

  /// Calls body(range) for disjoint ranges of numbers along the path, in no order; together they hold each cell that
  /// the box [min, max] meets, also around periodic axes, exactly once.
  template <class Body>
  HOOKE_HD void for_path_ranges(const Vec3d& min, const Vec3d& max, const Body& body) const {
    Stretches along[3];
    for (int k = 0; k < 3; ++k) along[k] = stretches(path[k], component(min, path[k]), component(max, path[k]));
    const std::int64_t end = axes[path[0]].count + 1;
    for (int sl = 0; sl < along[2].count; ++sl) {
      for (std::int64_t layer = along[2].of[sl].first; layer <= along[2].of[sl].last; ++layer) {
        for (int sr = 0; sr < along[1].count; ++sr) {
          for (std::int64_t r = along[1].of[sr].first; r <= along[1].of[sr].last; ++r) {
            const Row row = row_at(r, layer);
            for (int s = 0; s < along[0].count; ++s) {
              const auto [first, last] = along[0].of[s];
              body(KeyRange{static_cast<std::uint64_t>(row.start + (row.backwards ? end - last : first)),
                            static_cast<std::uint64_t>(row.start + (row.backwards ? end - first : last))});
            }
          }
        }
      }
    }
  }

  /// Index of the cell along an axis, 1 to its count.
  HOOKE_HD std::int64_t index_of(double x, int axis) const {
    const double cell = (x - axes[axis].origin) * inverse_cell[axis];
    // Clamped before the conversion, which is undefined for values beyond int64.
    const double inside = cell > 0 ? cell : 0;
    return static_cast<std::int64_t>(inside < last_cell[axis] ? inside : last_cell[axis]) + 1;
  }

  Axis axes[3];
  double inverse_cell[3] = {1, 1, 1};  // 1/m
  double last_cell[3] = {0, 0, 0};  // number of cells less one
  int path[3] = {0, 1, 2};  // the axes of the path: along rows, across the rows of a layer, across layers
  std::int64_t stride_y = 3, stride_z = 9;

 private:
  // A row of cells on the path.
  struct Row {
    std::int64_t start;  // the key before the row's first
    bool backwards;
  };
  HOOKE_HD Row row_at(std::int64_t row, std::int64_t layer) const {
    const std::int64_t rows = axes[path[1]].count, stride = axes[path[0]].count + 2;
    const std::int64_t on_path = mirrored(row, path[1], (layer & 1) != 0);
    return {(layer * (rows + 2) + on_path) * stride, (((layer & rows) ^ on_path) & 1) != 0};
  }
  // The index counted from the other end, if `yes`. Without a branch, which no processor could predict.
  HOOKE_HD std::int64_t mirrored(std::int64_t index, int axis, bool yes) const {
    return index + static_cast<std::int64_t>(yes) * (axes[axis].count + 1 - 2 * index);
  }

  // Indices first to last of an axis as one stretch, or as two where they wrap around a periodic axis.
  struct Stretches {
    Stretch of[2];
    int count;
  };
  HOOKE_HD Stretches stretches(int axis, double min, double max) const {
    const Axis& a = axes[axis];
    const double end = a.origin + a.length;
    if (!a.periodic || (min >= a.origin && max < end)) return {{{index_of(min, axis), index_of(max, axis)}, {}}, 1};
    if (!(max - min < a.length)) return {{{1, a.count}, {}}, 1};
    const double before = std::floor((min - a.origin) / a.length) * a.length;
    const std::int64_t first = index_of(min - before, axis);
    if (max - before < end) return {{{first, index_of(max - before, axis)}, {}}, 1};
    const std::int64_t last = index_of(max - before - a.length, axis);
    if (last >= first) return {{{1, a.count}, {}}, 1};
    return {{{first, a.count}, {1, last}}, 2};
  }
};

}  // namespace hooke
