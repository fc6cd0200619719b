// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hooke/base/assert.h"

namespace hooke::render {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

double norm(const Vec3d& v) { return std::sqrt(dot(v, v)); }
Vec3d normalized(const Vec3d& v) { return (1 / norm(v)) * v; }
// Up to rounding.
bool is_unit(const Vec3d& v) { return std::abs(dot(v, v) - 1) < 1e-6; }
// `v` turned about the unit vector `axis` (Rodrigues' formula).
Vec3d rotated(const Vec3d& v, const Vec3d& axis, double angle) {
  return std::cos(angle) * v + std::sin(angle) * cross(axis, v) + ((1 - std::cos(angle)) * dot(axis, v)) * axis;
}

std::array<Vec3d, 8> corners(const Box3d& box) {
  std::array<Vec3d, 8> all;
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z};
  }
  return all;
}

// What a path through `value` of the keyframes is at `time`: cubic between two of them, as fast at each as from the one
// before to the one after, at rest at both ends (E. Catmull and R. Rom, 1974).
template <class T, class Value>
T smooth_value(const std::vector<CameraKeyframe>& keys, double time, const Value& value) {
  if (time <= keys.front().time) return value(keys.front());
  if (time >= keys.back().time) return value(keys.back());
  const auto later = std::upper_bound(keys.begin(), keys.end(), time,
                                      [](double t, const CameraKeyframe& key) { return t < key.time; });
  const auto b = static_cast<std::size_t>(later - keys.begin()), a = b - 1;
  const auto rate = [&](std::size_t i) {
    if (i == 0 || i + 1 == keys.size()) return 0.0 * value(keys[i]);
    return (1 / (keys[i + 1].time - keys[i - 1].time)) * (value(keys[i + 1]) - value(keys[i - 1]));
  };
  const double span = keys[b].time - keys[a].time, s = (time - keys[a].time) / span;
  const double rise = s * s * (3 - 2 * s);
  return (1 - rise) * value(keys[a]) + rise * value(keys[b]) + (span * s * (1 - s) * (1 - s)) * rate(a) -
         (span * s * s * (1 - s)) * rate(b);
}

}  // namespace

CameraAxes axes(const Camera& camera) {
  HOOKE_ASSERT(norm(camera.eye - camera.target) > 0, camera.eye, camera.target);
  HOOKE_ASSERT(is_unit(camera.up), camera.up);
  HOOKE_ASSERT(norm(cross(camera.up, camera.eye - camera.target)) > 0, camera.up, camera.eye, camera.target);
  const Vec3d back = normalized(camera.eye - camera.target);
  const Vec3d right = normalized(cross(camera.up, back));
  return {right, cross(back, right), back};
}

Vec3d up_of(const Scene& scene) {
  const double strength = norm(scene.gravity);
  return strength > 0 ? (-1 / strength) * scene.gravity : Vec3d{0, 1, 0};
}

double extent_along(const Box3d& box, const Vec3d& direction) {
  HOOKE_ASSERT(is_unit(direction), direction);
  const Vec3d size = box.max - box.min;
  return std::abs(size.x * direction.x) + std::abs(size.y * direction.y) + std::abs(size.z * direction.z);
}

LevelAxes level_axes(const Box3d& box, const Vec3d& up) {
  HOOKE_ASSERT(is_unit(up), up);
  Vec3d longest{0, 0, 0};
  double most = -1;
  for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{0, 0, 1}, Vec3d{0, 1, 0}}) {
    const double length = dot(box.max - box.min, axis) * (1 - std::abs(dot(axis, up)));
    if (length > 1.001 * most) {
      most = length;
      longest = axis;
    }
  }
  const Vec3d across = normalized(longest - dot(longest, up) * up);
  return {across, cross(across, up)};
}

Vec3d direction_to_sun(const Box3d& box, const Vec3d& up) {
  const LevelAxes level = level_axes(box, up);
  return normalized(up + 0.4 * level.front + 0.6 * level.across);
}

Camera default_camera(const Box3d& box, const Vec3d& up, double field_of_view, double aspect) {
  HOOKE_ASSERT(aspect > 0, aspect);
  HOOKE_ASSERT(field_of_view > 0 && field_of_view < 180, field_of_view);
  constexpr double kElevation = 20 * kDegree, kAzimuth = -24 * kDegree;
  constexpr double kFilled = 0.92;  // of the picture's width or height
  const auto [across, front] = level_axes(box, up);
  const Vec3d from =
      std::cos(kElevation) * (std::cos(kAzimuth) * front + std::sin(kAzimuth) * across) + std::sin(kElevation) * up;
  Camera camera{box.center() + from, box.center(), up, field_of_view};
  const CameraAxes own = axes(camera);
  const double tangent_y = kFilled * std::tan(0.5 * field_of_view * kDegree);
  const double tangent_x = tangent_y * aspect;

  // In the camera's own axes, draw through each corner the two lines from which the corner is seen at the one and at
  // the other rim of the picture. The eye must lie above all lines of the one rim and below all lines of the other.
  // The nearest eye that sees everything is where both wedges (x, y) allow it.
  struct Wedge {
    double high = -1e300, low = 1e300;  // bounds of  shift + distance * tangent  and  shift - distance * tangent
  };
  Wedge x, y;
  for (const Vec3d& corner : corners(box)) {
    const Vec3d c = corner - box.center();
    const double depth = dot(c, own.back);
    const double right = dot(c, own.right), high = dot(c, own.up);
    x.high = std::max(x.high, right + depth * tangent_x);
    x.low = std::min(x.low, right - depth * tangent_x);
    y.high = std::max(y.high, high + depth * tangent_y);
    y.low = std::min(y.low, high - depth * tangent_y);
  }
  const double distance = std::max((x.high - x.low) / (2 * tangent_x), (y.high - y.low) / (2 * tangent_y));
  camera.target = box.center() + (0.5 * (x.high + x.low)) * own.right + (0.5 * (y.high + y.low)) * own.up;
  camera.eye = camera.target + distance * own.back;
  return camera;
}

std::optional<Vec3d> followed_point(const Scene& scene, const ParticleSet& particles, double time) {
  if (!scene.camera.follow) return {};
  if (scene.camera.follow->collider) return pose_at(scene.colliders.at(*scene.camera.follow->collider), time).pivot;
  Vec3d sum{0, 0, 0};
  std::size_t count = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.material[i] != *scene.camera.follow->material) continue;
    sum += particles.position[i];
    ++count;
  }
  if (count == 0) return {};
  return (1 / static_cast<double>(count)) * sum;
}

Camera camera_at(const Scene& scene, const Box3d& action, double aspect, double time,
                 const std::optional<Vec3d>& followed) {
  const SceneCamera& wanted = scene.camera;
  Camera camera = default_camera(action, up_of(scene), wanted.field_of_view, aspect);
  if (wanted.target) {
    if (!wanted.eye) camera.eye += *wanted.target - camera.target;
    camera.target = *wanted.target;
  }
  if (wanted.eye) camera.eye = *wanted.eye;
  double roll = wanted.roll;
  if (const auto& keys = wanted.keyframes; !keys.empty()) {
    const auto own = [](const auto& value, const auto& fallback) { return value ? *value : fallback; };
    const Camera base = camera;
    camera.eye = smooth_value<Vec3d>(keys, time, [&](const CameraKeyframe& k) { return own(k.eye, base.eye); });
    camera.target =
        smooth_value<Vec3d>(keys, time, [&](const CameraKeyframe& k) { return own(k.target, base.target); });
    camera.field_of_view =
        std::clamp(smooth_value<double>(
                       keys, time, [&](const CameraKeyframe& k) { return own(k.field_of_view, base.field_of_view); }),
                   1.0, 150.0);
    roll = smooth_value<double>(keys, time, [&](const CameraKeyframe& k) { return own(k.roll, wanted.roll); });
    // Paths between keyframes may meet.
    if (camera.eye == camera.target) camera.eye += base.eye - base.target;
  }
  if (followed) {
    camera.eye += *followed - camera.target;
    camera.target = *followed;
  }
  camera.eye = camera.target + rotated(camera.eye - camera.target, camera.up, wanted.orbit * kDegree * time);
  // For a view straight up or down, any level direction will do as the top of the picture.
  const Vec3d view = normalized(camera.eye - camera.target);
  if (std::abs(dot(view, camera.up)) > 0.9999) camera.up = -level_axes(action, camera.up).front;
  if (roll != 0) camera.up = normalized(rotated(camera.up, view, -roll * kDegree));
  return camera;
}

}  // namespace hooke::render
