// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "hooke/base/assert.h"
#include "hooke/physics/shapes.h"

namespace hooke {

// Which points lie inside a shape, however far from its surface.

/// In the directory of a distance field: a brick without samples, wholly inside a closed mesh.
inline constexpr std::int32_t kBrickInside = -2;

/// Whether `at` (m, from the field's origin) is inside the closed mesh of a field: where there are samples, the
/// interpolated distance is negative. No point is inside an open mesh.
inline bool encloses(const DistanceFieldView& field, const Vec3d& at) {
  HOOKE_ASSERT(field.directory != nullptr && field.cell > 0, field.directory, field.cell);
  const Vec3d u = (1 / field.cell) * at;
  std::size_t place = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const double cells = component(u, axis);
    const std::int32_t bricks = field.bricks[axis];
    if (!(cells >= 0 && cells < static_cast<double>(bricks * DistanceFieldView::kCells))) return false;
    place = place * static_cast<std::size_t>(bricks) +
            static_cast<std::size_t>(static_cast<std::int32_t>(cells) / DistanceFieldView::kCells);
  }
  const std::int32_t brick = field.directory[place];
  return brick < 0 ? brick == kBrickInside : field_value(field, u) < 0;
}

/// Whether x (m) is inside the solid; for a plane, behind it.
inline bool encloses(const ShapeGeometry<double>& shape, const Vec3d& x) {
  if (shape.kind == ShapeKind::mesh) return encloses(shape.field, x - shape.center);
  return shape_distance(shape, x).distance < 0;
}

}  // namespace hooke
