// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/core/scene_picture.h"

#include "hooke/base/format.h"

#include <cmath>
#include <utility>

namespace hooke {

namespace {

class Checker {
 public:
  std::vector<Finding> findings;

  void add(const std::string& where, std::string message) { findings.push_back({where, std::move(message)}); }
  void finite(const std::string& where, double value) {
    if (!std::isfinite(value)) add(where, formatted("{} is not a finite number", value));
  }
  void finite(const std::string& where, const std::optional<Vec3d>& point) {
    for (int axis = 0; point && axis < 3; ++axis) finite(formatted("{}[{}]", where, axis), component(*point, axis));
  }
  void angle_of_view(const std::string& where, double degrees) {
    if (!(degrees >= 1 && degrees <= 150)) add(where, formatted("{} must be from 1 to 150 degrees", degrees));
  }
  void brightness(const std::string& where, double value) {
    finite(where, value);
    if (value < 0) add(where, formatted("{} must be 0 or more", value));
  }
};

}  // namespace

std::vector<Finding> validate(const SceneCamera& camera) {
  Checker check;
  check.finite("camera.eye", camera.eye);
  check.finite("camera.target", camera.target);
  if (camera.eye && camera.target && *camera.eye == *camera.target) {
    check.add("camera.target", "must be another point than camera.eye");
  }
  check.angle_of_view("camera.field_of_view", camera.field_of_view);
  check.finite("camera.orbit", camera.orbit);
  check.finite("camera.roll", camera.roll);
  for (std::size_t i = 0; i < camera.keyframes.size(); ++i) {
    const CameraKeyframe& key = camera.keyframes[i];
    const std::string where = formatted("camera.keyframes[{}]", i);
    check.finite(where + ".time", key.time);
    check.finite(where + ".eye", key.eye);
    check.finite(where + ".target", key.target);
    check.finite(where + ".roll", key.roll.value_or(0));
    check.angle_of_view(where + ".field_of_view", key.field_of_view.value_or(camera.field_of_view));
    if (i > 0 && !(key.time > camera.keyframes[i - 1].time)) {
      check.add(where + ".time", formatted("{} must be later than that of the keyframe before, {}", key.time,
                                           camera.keyframes[i - 1].time));
    }
    const auto eye = key.eye ? key.eye : camera.eye, target = key.target ? key.target : camera.target;
    if ((key.eye || key.target) && eye && target && *eye == *target) {
      check.add(where, "must not have the eye at the target");
    }
  }
  return std::move(check.findings);
}

std::vector<Finding> validate(const ScenePicture& picture) {
  Checker check;
  check.finite("picture.sun", picture.sun);
  if (picture.sun && *picture.sun == Vec3d{0, 0, 0}) check.add("picture.sun", "is 0; it must have a direction");
  check.brightness("picture.sunlight", picture.sunlight);
  check.brightness("picture.skylight", picture.skylight);
  return std::move(check.findings);
}

}  // namespace hooke
