// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/core/scene.h"
#include "hooke/physics/periodic.h"

namespace hooke {

/// From y to the nearest image of x, m.
inline Vec3d nearest_displacement(const Domain& domain, const Vec3d& x, const Vec3d& y) {
  Vec3d off = x - y;
  for (int axis = 0; axis < 3; ++axis) {
    if (domain.boundary[static_cast<std::size_t>(axis)] != Boundary::periodic) continue;
    const double a = component(x, axis), b = component(y, axis), length = domain.length(axis);
    component(off, axis) = image_displacement(a, b, nearest_image(a, b, length), length);
  }
  return off;
}

}  // namespace hooke
