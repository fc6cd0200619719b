// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

#include "hooke/backends/gpu/brick_grid.h"
#include "hooke/backends/gpu/device_report.h"
#include "hooke/backends/gpu/warp.h"
#include "hooke/base/vec3.h"

namespace hooke::gpu {

// Whether the list still holds all pairs that touch. Every warp keeps the box around the displacements of its particles
// since the list was built; particles of adjacent bricks that have come nearer by less than the skin do not touch
// unless they are listed. A whole box bounds it for bricks that are further apart.

/// The box around the displacements of a warp's particles: ordered() along x, y, z, -x, -y, -z, 0 where there is none.
struct WarpMoves {
  std::uint32_t most[8];
};

/// Takes up one displacement (m) an item; all items of a warp call it together. `counts`: whether the item has one.
template <class Real>
HOOKE_HD void add_move(WarpMoves* moves, std::uint32_t i, bool counts, const Vec3<Real>& moved) {
  std::uint32_t* const most = moves[i / kWarp].most;
  const float away[3] = {static_cast<float>(moved.x), static_cast<float>(moved.y), static_cast<float>(moved.z)};
  for (int axis = 0; axis < 3; ++axis) {
    // NaN is further than anything.
    const float a = away[axis] == away[axis] ? away[axis] : __builtin_inff();
    const float b = away[axis] == away[axis] ? -away[axis] : __builtin_inff();
    raise_by_warp(most + axis, counts ? ordered(a) : 0);
    raise_by_warp(most + axis + 3, counts ? ordered(b) : 0);
  }
}

/// The square of the longest difference of two vectors, of which one is in each box: a square of metres.
HOOKE_HD float farthest2(const std::uint32_t (&a)[6], const std::uint32_t (&b)[6]) {
  float sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float ahead = from_ordered(a[axis]) + from_ordered(b[axis + 3]);
    const float behind = from_ordered(b[axis]) + from_ordered(a[axis + 3]);
    const float far = ahead > behind ? ahead : behind;
    sum = sum + far * far;
  }
  return sum;
}

/// Items are warps, in whole warps: the box around all displacements.
struct BoundMoves {
  const WarpMoves* moves;
  std::uint32_t warps;
  DeviceReport* report;

  HOOKE_HD void operator()(std::uint32_t w) const {
    for (int k = 0; k < 6; ++k) raise_by_warp(report->moved + k, w < warps ? moves[w].most[k] : 0);
  }
};

/// Fourteen items a brick: compares it with itself and with half of the bricks around it. For grids that are not
/// hashed.
struct CompareBricks {
  static constexpr std::uint32_t kItems = 14;

  BrickGrid grid;
  const std::uint32_t* start;  // of each cell
  const WarpMoves* moves;
  float skin2;  // m^2
  DeviceReport* report;

  HOOKE_HD void operator()(std::uint32_t item) const {
    const std::uint32_t b = item / kItems, side = 13 + item % kItems;  // of the 27 around; 13 is the middle
    std::uint32_t at[3] = {b % grid.axes[0].bricks, b / grid.axes[0].bricks % grid.axes[1].bricks,
                           b / grid.axes[0].bricks / grid.axes[1].bricks};
    const std::uint32_t step[3] = {side % 3, side / 3 % 3, side / 9};  // 0, 1, 2: before, the same, after
    for (int a = 0; a < 3; ++a) {
      const std::uint32_t n = grid.axes[a].bricks;
      const std::uint32_t to = at[a] + step[a];  // one too many
      if ((to == 0 || to == n + 1) && !grid.axes[a].periodic) return;
      at[a] = to == 0 ? n - 1 : to == n + 1 ? 0 : to - 1;
    }
    std::uint32_t own[6], other[6];
    if (!box_of(b, own)) return;
    if (!box_of((at[2] * grid.axes[1].bricks + at[1]) * grid.axes[0].bricks + at[0], other)) return;
    if (!(farthest2(own, other) < skin2)) raise_to(&report->stale, 1);
  }

 private:
  // The box around the displacements of a brick's particles, or more; false where there is none.
  HOOKE_HD bool box_of(std::uint32_t brick, std::uint32_t (&most)[6]) const {
    const std::uint32_t first = start[brick * BrickGrid::kCells], end = start[(brick + 1) * BrickGrid::kCells];
    for (int k = 0; k < 6; ++k) most[k] = 0;
    if (first == end) return false;
    for (std::uint32_t w = first / kWarp; w <= (end - 1) / kWarp; ++w) {
      for (int k = 0; k < 6; ++k) most[k] = moves[w].most[k] > most[k] ? moves[w].most[k] : most[k];
    }
    return most[0] != 0;
  }
};

/// One item: whether the list is stale by the longest displacement of all.
struct JudgeMoves {
  float limit;  // m: what two particles that no bricks were compared for may come nearer
  float largest_kept;  // m: displacements above it are too far for the rounding of floats
  DeviceReport* report;

  HOOKE_HD void operator()(std::uint32_t) const {
    if (report->moved[0] == 0) return;
    bool good = farthest2(report->moved, report->moved) < limit * limit;
    for (const std::uint32_t moved : report->moved) good = good && from_ordered(moved) < largest_kept;
    if (!good) report->stale = 1;
  }
};

}  // namespace hooke::gpu
