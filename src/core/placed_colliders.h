// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "hooke/core/colliders.h"
#include "hooke/physics/collider.h"

namespace hooke {

namespace detail {

template <class S>
ShapeGeometry<S> rounded(const ShapeGeometry<double>& g) {
  return {g.kind,
          g.hollow,
          vec_cast<S>(g.center),
          vec_cast<S>(g.axis),
          vec_cast<S>(g.across),
          vec_cast<S>(g.half),
          static_cast<S>(g.half_length),
          static_cast<S>(g.radius),
          g.field};
}

}  // namespace detail

/// A collider where it is, in a back end's number type. `reach`: no further from a particle's centre it acts, m.
template <class S>
PlacedCollider<S> place_collider(const Collider& collider, const ColliderPose& pose, double reach) {
  PlacedCollider<S> placed;
  const Vec3d pivot = pivot_of(collider);
  placed.shape = detail::rounded<S>(geometry_of(collider.shape, collider.hollow, pivot));
  placed.pivot = vec_cast<S>(pose.pivot);
  for (std::size_t axis = 0; axis < 3; ++axis) placed.turn[axis] = vec_cast<S>(pose.turn[axis]);
  placed.velocity = vec_cast<S>(pose.velocity);
  placed.angular_velocity = vec_cast<S>(pose.angular_velocity);
  // The box around the turned box of the shape, a little wider than what rounding takes.
  const ShapeBounds box = bounds_of(collider.shape);
  const Vec3d middle = moved_point(collider, pose, 0.5 * (box.min + box.max)), half = 0.5 * (box.max - box.min);
  for (int axis = 0; axis < 3; ++axis) {
    double far = reach;
    for (int own = 0; own < 3; ++own) {
      far += std::abs(component(pose.turn[static_cast<std::size_t>(own)], axis)) * component(half, own);
    }
    const double at = component(middle, axis), slack = 1e-5 * (far + std::abs(at));
    const bool everywhere = !std::isfinite(far);  // a plane
    component(placed.near_from, axis) = static_cast<S>(everywhere ? -kBeyondReach : at - far - slack);
    component(placed.near_to, axis) = static_cast<S>(everywhere ? kBeyondReach : at + far + slack);
  }
  return placed;
}

}  // namespace hooke
