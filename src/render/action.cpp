// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/action.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/render/camera.h"

namespace hooke::render {

namespace {

double longest_side(const Box3d& box) {
  const Vec3d size = box.extent();
  return std::max({size.x, size.y, size.z});
}

void grow(Box3d& box, double by) {
  box.min -= Vec3d{by, by, by};
  box.max += Vec3d{by, by, by};
}

double largest_radius(const Scene& scene) {
  double most = 0;
  for (const Material& material : scene.materials) most = std::max(most, material.radius);
  return most;
}

// The box around all centres but the outermost `share` on each side.
Box3d box_of_most(const ParticleSet& particles, double share) {
  Box3d box = Box3d::none();
  if (particles.empty()) return box;
  const auto left_out = static_cast<std::ptrdiff_t>(share * static_cast<double>(particles.size()));
  std::vector<double> along(particles.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < along.size(); ++i) along[i] = component(particles.position[i], axis);
    std::nth_element(along.begin(), along.begin() + left_out, along.end());
    component(box.min, axis) = along[static_cast<std::size_t>(left_out)];
    std::nth_element(along.begin(), along.end() - 1 - left_out, along.end());
    component(box.max, axis) = along[along.size() - 1 - static_cast<std::size_t>(left_out)];
  }
  return box;
}

// Adds emitters, and the colliders that are no larger than what is there already, in the domain.
void add_furniture(const Scene& scene, Box3d& box) {
  const auto add = [&](const Shape& shape) {
    Box3d own = bounds_of(shape);
    for (int axis = 0; axis < 3; ++axis) {
      component(own.min, axis) = std::max(component(own.min, axis), component(scene.domain.min, axis));
      component(own.max, axis) = std::min(component(own.max, axis), component(scene.domain.max, axis));
      if (component(own.min, axis) > component(own.max, axis)) return;  // outside
    }
    box.add(own);
  };
  for (const Emitter& emitter : scene.emitters) add(emitter.shape);
  const double most = box.is_none() ? INFINITY : 2 * longest_side(box);
  for (const Collider& collider : scene.colliders) {
    if (std::holds_alternative<PlaneShape>(collider.shape)) continue;
    if (longest_side(bounds_of(collider.shape)) <= most) add(collider.shape);
  }
}

// The axis along which gravity points, and whether up is along it; else none.
struct UpAxis {
  int axis = -1;
  bool positive = true;
};

UpAxis up_axis(const Scene& scene) {
  const Vec3d up = up_of(scene);
  if (scene.gravity == Vec3d{0, 0, 0}) return {};
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(component(up, axis)) >= 0.9) return {axis, component(up, axis) > 0};
  }
  return {};
}

// Cuts the axis of `box` to [low, high].
void cut(Box3d& box, int axis, double low, double high) {
  component(box.min, axis) = std::max(component(box.min, axis), low);
  component(box.max, axis) = std::min(component(box.max, axis), high);
}

}  // namespace

Box3d action_box(const Scene& scene, const ParticleSet& first) {
  HOOKE_ASSERT(are_particles_of(first, scene), first.size(), scene.materials.size());
  constexpr double kHeadroom = 1.15, kMuchLarger = 4;
  const Box3d domain{scene.domain.min, scene.domain.max};
  Box3d box = domain, there = box_of_most(first, 0);
  if (!there.is_none()) grow(there, largest_radius(scene));
  const UpAxis up = up_axis(scene);
  double reach = 0;  // how far what is there may spread, m
  if (up.axis >= 0 && !first.empty()) {
    double& floor = component(up.positive ? box.min : box.max, up.axis);
    double& ceiling = component(up.positive ? box.max : box.min, up.axis);
    for (std::size_t i = 0; i < first.size(); ++i) {
      const double height = std::abs(component(first.position[i], up.axis) - floor);
      reach = std::max(reach, height + scene.materials[first.material[i]].radius);
    }
    const double height = std::min(kHeadroom * reach, scene.domain.length(up.axis));
    ceiling = floor + (up.positive ? height : -height);
  }
  add_furniture(scene, there);
  if (there.is_none()) return box;
  reach = std::max(reach, longest_side(there));
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == up.axis || scene.domain.length(axis) <= kMuchLarger * reach) continue;
    cut(box, axis, component(there.min, axis) - reach, component(there.max, axis) + reach);
  }
  return box;
}

Box3d seen_action_box(const Scene& scene, std::span<const ParticleSet> moments) {
  HOOKE_ASSERT(!moments.empty());
  constexpr double kOutliers = 0.005, kRoom = 0.06, kHeadroom = 0.12, kLarger = 1.25, kNear = 0.5;
  Box3d there = Box3d::none();
  for (const ParticleSet& particles : moments) {
    HOOKE_ASSERT(are_particles_of(particles, scene), particles.size(), scene.materials.size());
    there.add(box_of_most(particles, kOutliers));
  }
  if (there.is_none()) return action_box(scene, moments.front());
  grow(there, largest_radius(scene));
  add_furniture(scene, there);
  const double size = longest_side(there);
  Box3d box{scene.domain.min, scene.domain.max};
  const UpAxis up = up_axis(scene);
  for (int axis = 0; axis < 3; ++axis) {
    double low = component(there.min, axis), high = component(there.max, axis);
    if (axis == up.axis) {
      const double headroom = kHeadroom * (high - low);
      (up.positive ? high : low) += up.positive ? headroom : -headroom;
      // The floor is in the picture unless all stay far above it.
      const double floor = component(up.positive ? box.min : box.max, axis);
      double& lowest = up.positive ? low : high;
      const double above = std::abs(lowest - floor);
      lowest = above < kNear * size ? floor : lowest - (up.positive ? 1 : -1) * kRoom * size;
      cut(box, axis, low, high);
    } else if (scene.domain.length(axis) > kLarger * (high - low)) {
      cut(box, axis, low - kRoom * size, high + kRoom * size);
    }
  }
  return box;
}

}  // namespace hooke::render
