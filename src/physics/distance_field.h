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

  double cell = 1;                            ///< edge of a cell, m
  std::int32_t bricks[3] = {0, 0, 0};         ///< along the axes, from the field's origin
  const std::int32_t* directory = nullptr;    ///< of every brick its number among `samples`, or kNothing; x fastest
  const float* samples = nullptr;             ///< m, 729 a brick
};

/// Distance at `at` (m, from the field's origin): trilinear between the samples around; the normal is the direction of
/// its gradient. kBeyondReach where there is no brick. Where the gradient vanishes the normal is +y.
template <class S>
HOOKE_HD SurfaceDistance<S> field_distance(const DistanceFieldView& field, const Vec3<S>& at) {
  constexpr int kCells = DistanceFieldView::kCells, kSamples = DistanceFieldView::kSamples;
  const SurfaceDistance<S> nothing{static_cast<S>(kBeyondReach), {S(0), S(1), S(0)}};
  const S per_cell = S(1) / static_cast<S>(field.cell);
  const S u[3] = {at.x * per_cell, at.y * per_cell, at.z * per_cell};
  std::int32_t cell[3];
  S f[3];  // how far into the cell, 0 to 1
  for (int axis = 0; axis < 3; ++axis) {
    if (!(u[axis] >= S(0) && u[axis] < static_cast<S>(field.bricks[axis] * kCells))) return nothing;
    cell[axis] = static_cast<std::int32_t>(u[axis]);
    f[axis] = u[axis] - static_cast<S>(cell[axis]);
  }
  const std::size_t brick_at = (static_cast<std::size_t>(cell[2] / kCells) * static_cast<std::size_t>(field.bricks[1]) +
                                static_cast<std::size_t>(cell[1] / kCells)) *
                                   static_cast<std::size_t>(field.bricks[0]) +
                               static_cast<std::size_t>(cell[0] / kCells);
  const std::int32_t brick = field.directory[brick_at];
  if (brick < 0) return nothing;
  const float* s = field.samples + static_cast<std::size_t>(brick) * (kSamples * kSamples * kSamples) +
                   ((cell[2] % kCells) * kSamples + cell[1] % kCells) * kSamples + cell[0] % kCells;
  // Always inlined, too: these are the same for every instruction set.
  const auto sample = [s](int x, int y, int z) __attribute__((always_inline)) {
    return static_cast<S>(s[(z * kSamples + y) * kSamples + x]);
  };
  const auto mix = [](S a, S b, S share) __attribute__((always_inline)) { return a + share * (b - a); };
  // Along x, then y, then z; beside the value its slopes.
  const S d00 = sample(1, 0, 0) - sample(0, 0, 0), d10 = sample(1, 1, 0) - sample(0, 1, 0);
  const S d01 = sample(1, 0, 1) - sample(0, 0, 1), d11 = sample(1, 1, 1) - sample(0, 1, 1);
  const S v00 = sample(0, 0, 0) + f[0] * d00, v10 = sample(0, 1, 0) + f[0] * d10;
  const S v01 = sample(0, 0, 1) + f[0] * d01, v11 = sample(0, 1, 1) + f[0] * d11;
  const S v0 = mix(v00, v10, f[1]), v1 = mix(v01, v11, f[1]);
  const Vec3<S> slope{mix(mix(d00, d10, f[1]), mix(d01, d11, f[1]), f[2]), mix(v10 - v00, v11 - v01, f[2]), v1 - v0};
  const S steepness = sqrt_of(dot(slope, slope));
  if (!(steepness > S(0))) return {mix(v0, v1, f[2]), nothing.normal};
  return {mix(v0, v1, f[2]), (S(1) / steepness) * slope};
}

}  // namespace hooke
