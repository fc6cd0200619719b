// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/core/colliders.h"
#include "hooke/core/rules_view.h"
#include "hooke/core/scene.h"
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

/// A collider in its pose, in a back end's number type. It acts within `reach` (m, >= 0) of a particle's centre.
template <class S>
PlacedCollider<S> place_collider(const Collider& collider, const ColliderPose& pose, double reach) {
  HOOKE_ASSERT(reach >= 0, collider.name, reach);
  PlacedCollider<S> placed;
  const Vec3d pivot = pivot_of(collider);
  placed.shape = detail::rounded<S>(geometry_of(collider.shape, collider.hollow, pivot));
  placed.pivot = vec_cast<S>(pose.pivot);
  for (std::size_t axis = 0; axis < 3; ++axis) placed.turn[axis] = vec_cast<S>(pose.turn[axis]);
  placed.velocity = vec_cast<S>(pose.velocity);
  placed.angular_velocity = vec_cast<S>(pose.angular_velocity);
  // The box around the turned box of the shape, with a margin for rounding.
  const Box3d box = bounds_of(collider.shape);
  const Vec3d middle = moved_point(collider, pose, box.center()), half = 0.5 * box.extent();
  for (int axis = 0; axis < 3; ++axis) {
    double far = reach;
    for (int own = 0; own < 3; ++own) {
      far += std::abs(component(pose.turn[static_cast<std::size_t>(own)], axis)) * component(half, own);
    }
    const double at = component(middle, axis), slack = 1e-5 * (far + std::abs(at));
    const bool everywhere = !std::isfinite(far);  // a plane
    component(placed.near.min, axis) = static_cast<S>(everywhere ? -kBeyondReach : at - far - slack);
    component(placed.near.max, axis) = static_cast<S>(everywhere ? kBeyondReach : at + far + slack);
  }
  return placed;
}

/// All colliders of a scene in their poses, in its order, each with its images across periodic faces.
template <class S>
struct PlacedColliders {
  std::vector<PlacedCollider<S>> all;
  std::vector<std::uint32_t> of;  ///< the index in the scene of each

  /// For loops to read, as long as this object does not change.
  CollidersView<S> view() const {
    CollidersView<S> view{all.data(), of.data(), all.size(), Box3<S>::none()};
    for (const PlacedCollider<S>& collider : all) view.near.add(collider.near);
    return view;
  }
};

/// `poses` has one for each collider; `reach` as above. A collider that is shorter along a periodic axis than the
/// domain gets all images that can be touched inside of the domain, even after it has crossed a face. A longer one,
/// such as a plane, spans the domain and is there once, without images.
template <class S>
PlacedColliders<S> place_colliders(const Scene& scene, std::span<const ColliderPose> poses, double reach) {
  HOOKE_ASSERT(poses.size() == scene.colliders.size(), poses.size(), scene.colliders.size());
  PlacedColliders<S> placed;
  for (std::uint32_t c = 0; c < poses.size(); ++c) {
    const Collider& collider = scene.colliders[c];
    const PlacedCollider<double> body = place_collider<double>(collider, poses[c], 0);
    const PlacedCollider<double> near = place_collider<double>(collider, poses[c], reach);
    std::int64_t from[3] = {0, 0, 0}, to[3] = {0, 0, 0};
    for (int axis = 0; axis < 3; ++axis) {
      const double length = scene.domain.length(axis);
      const bool periodic = scene.domain.boundary[static_cast<std::size_t>(axis)] == Boundary::periodic;
      if (!periodic || !(component(body.near.max, axis) - component(body.near.min, axis) < length)) continue;
      from[axis] = static_cast<std::int64_t>(
          std::ceil((component(scene.domain.min, axis) - component(near.near.max, axis)) / length));
      to[axis] = static_cast<std::int64_t>(
          std::floor((component(scene.domain.max, axis) - component(near.near.min, axis)) / length));
    }
    for (std::int64_t sx = from[0]; sx <= to[0]; ++sx) {
      for (std::int64_t sy = from[1]; sy <= to[1]; ++sy) {
        for (std::int64_t sz = from[2]; sz <= to[2]; ++sz) {
          ColliderPose image = poses[c];
          image.pivot +=
              Vec3d{static_cast<double>(sx) * scene.domain.length(0), static_cast<double>(sy) * scene.domain.length(1),
                    static_cast<double>(sz) * scene.domain.length(2)};
          placed.all.push_back(place_collider<S>(collider, image, reach));
          placed.of.push_back(c);
        }
      }
    }
  }
  return placed;
}

}  // namespace hooke
