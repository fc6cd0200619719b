// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "hooke/base/vec3.h"

namespace hooke {

/// How far a point is from a surface, and where it is then nearest.
template <class R>
struct SurfaceDistance {
  R distance;      ///< m; negative inside of a solid
  Vec3<R> normal;  ///< unit vector along which the distance grows
};

/// A distance further than anything touches, m.
inline constexpr double kBeyondReach = 1e18;

/// The distance from a surface on a cubic grid, around the surface only: bricks of 8 cells an axis, each with the
/// 9 x 9 x 9 samples at its cells' corners, x fastest, so that a brick needs no neighbour. Plain data: whoever owns it
/// keeps it (core/distance_field.h).
struct DistanceFieldView {
  static constexpr int kCells = 8, kSamples = kCells + 1;
  static constexpr std::int32_t kNothing = -1;  ///< no brick: nothing near

  double cell = 1;                          ///< edge of a cell, m
  std::int32_t bricks[3] = {0, 0, 0};       ///< along the axes, from the field's origin
  const std::int32_t* directory = nullptr;  ///< of every brick its number among `samples`, or kNothing; x fastest
  const float* samples = nullptr;           ///< m, 729 a brick
};

/// Distance (m) at `at`, in cells from the field's origin: trilinear between the samples around; kBeyondReach where
/// there is no brick.
template <class S>
HOOKE_HD S field_value(const DistanceFieldView& field, const Vec3<S>& at) {
  constexpr int kCells = DistanceFieldView::kCells, kSamples = DistanceFieldView::kSamples;
  const S u[3] = {at.x, at.y, at.z};
  std::int32_t cell[3];
  S f[3];  // how far into the cell, 0 to 1
  for (int axis = 0; axis < 3; ++axis) {
    if (!(u[axis] >= S(0) && u[axis] < static_cast<S>(field.bricks[axis] * kCells))) {
      return static_cast<S>(kBeyondReach);
    }
    cell[axis] = static_cast<std::int32_t>(u[axis]);
    f[axis] = u[axis] - static_cast<S>(cell[axis]);
  }
  const auto columns = static_cast<std::size_t>(field.bricks[0]), rows = static_cast<std::size_t>(field.bricks[1]);
  const std::size_t place =
      (static_cast<std::size_t>(cell[2] / kCells) * rows + static_cast<std::size_t>(cell[1] / kCells)) * columns +
      static_cast<std::size_t>(cell[0] / kCells);
  const std::int32_t brick = field.directory[place];
  if (brick < 0) return static_cast<S>(kBeyondReach);
  const float* s = field.samples + static_cast<std::size_t>(brick) * (kSamples * kSamples * kSamples) +
                   ((cell[2] % kCells) * kSamples + cell[1] % kCells) * kSamples + cell[0] % kCells;
  // Always inlined, too: these are the same for every instruction set.
  const auto along_x = [s, &f](int y, int z) __attribute__((always_inline)) {
    const float* row = s + (z * kSamples + y) * kSamples;
    const S a = static_cast<S>(row[0]), b = static_cast<S>(row[1]);
    return a + f[0] * (b - a);
  };
  const auto mix = [](S a, S b, S share) __attribute__((always_inline)) { return a + share * (b - a); };
  return mix(mix(along_x(0, 0), along_x(1, 0), f[1]), mix(along_x(0, 1), along_x(1, 1), f[1]), f[2]);
}

/// Distance at `at` (m, from the field's origin) and its gradient's direction: differences over half a cell either way,
/// so that the normal turns steadily from cell to cell. kBeyondReach, and +y, where there is no brick near or nothing
/// changes.
template <class S>
HOOKE_HD SurfaceDistance<S> field_distance(const DistanceFieldView& field, const Vec3<S>& at) {
  const S per_cell = S(1) / static_cast<S>(field.cell);
  const Vec3<S> u{at.x * per_cell, at.y * per_cell, at.z * per_cell};
  const SurfaceDistance<S> nothing{static_cast<S>(kBeyondReach), {S(0), S(1), S(0)}};
  const S distance = field_value(field, u), far = static_cast<S>(kBeyondReach);
  if (distance == far) return nothing;
  Vec3<S> slope{};
  for (int axis = 0; axis < 3; ++axis) {
    Vec3<S> ahead = u, behind = u;
    component(ahead, axis) = component(ahead, axis) + S(0.5);
    component(behind, axis) = component(behind, axis) - S(0.5);
    const S a = field_value(field, ahead), b = field_value(field, behind);
    if (a == far || b == far) return nothing;
    component(slope, axis) = a - b;
  }
  const S steepness = sqrt_of(dot(slope, slope));
  if (!(steepness > S(0))) return nothing;
  return {distance, (S(1) / steepness) * slope};
}

}  // namespace hooke
