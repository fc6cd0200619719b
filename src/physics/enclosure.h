// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "hooke/base/assert.h"
#include "hooke/physics/collider.h"

namespace hooke {

// Which points lie inside a shape, however far from its surface.

/// Whether a brick without samples lies inside the closed mesh of a field: along its row the surface lies between the
/// inside and the next brick with samples, whose first one tells on which side of it the gap is.
HOOKE_HD bool is_inside_gap(const DistanceFieldView& field, std::uint64_t key) {
  std::int32_t begin = 0, end = field.count;  // of the bricks among which the first one behind `key` is
  while (begin < end) {
    const std::int32_t middle = begin + (end - begin) / 2;
    if (field.keys[middle] > key) {
      end = middle;
    } else {
      begin = middle + 1;
    }
  }
  constexpr unsigned kBits = DistanceFieldView::kKeyBits;
  if (begin == field.count || field.keys[begin] >> kBits != key >> kBits) return false;
  constexpr std::size_t kPerBrick =
      std::size_t{DistanceFieldView::kSamples} * DistanceFieldView::kSamples * DistanceFieldView::kSamples;
  return field.samples[static_cast<std::size_t>(begin) * kPerBrick] < 0;
}

/// Whether `at` (m, from the field's origin) is inside the closed mesh of a field: where there are samples, the
/// interpolated distance is negative. No point is inside an open mesh.
HOOKE_HD bool encloses(const DistanceFieldView& field, const Vec3d& at) {
  HOOKE_ASSERT(field.slots != nullptr && field.cell > 0, field.slots, field.cell);
  const Vec3d u = (1 / field.cell) * at;
  std::int32_t brick[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = component(u, axis);
    if (!(cells >= 0 && cells < static_cast<double>(field.bricks[axis] * DistanceFieldView::kCells))) return false;
    brick[axis] = static_cast<std::int32_t>(cells) / DistanceFieldView::kCells;
  }
  const std::uint64_t key = brick_key(brick[0], brick[1], brick[2]);
  return find_brick(field, key) < 0 ? is_inside_gap(field, key) : field_value(field, u) < 0;
}

/// Whether x (m) is inside the solid; for a plane, behind it.
HOOKE_HD bool encloses(const ShapeGeometry<double>& shape, const Vec3d& x) {
  if (shape.kind == ShapeKind::mesh) return encloses(shape.field, x - shape.center);
  return shape_distance(shape, x).distance < 0;
}

/// The same for a shape where it is placed; whether it is hollow makes no difference.
HOOKE_HD bool encloses(const PlacedCollider<double>& body, const Vec3d& x) {
  const Vec3d off = x - body.pivot;
  return encloses(body.shape, Vec3d{dot(body.turn[0], off), dot(body.turn[1], off), dot(body.turn[2], off)});
}

}  // namespace hooke
