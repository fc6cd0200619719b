// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/collider_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "hooke/scene/json_path.h"
#include "hooke/scene/material_names.h"
#include "hooke/scene/scene_builder.h"

namespace hooke::scene {
namespace {

// Turns an axis and an angle in degrees into a vector along the axis whose length is the angle in rad.
std::optional<Vec3d> rotation_of(const Json& json, const std::string& where, Findings& findings) {
  const Vec3d axis{json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
  const double angle = json[3].get<double>() * (std::numbers::pi / 180);
  const double length = std::sqrt(dot(axis, axis));
  if (length > 0) return (angle / length) * axis;
  if (angle == 0) return Vec3d{0, 0, 0};
  findings.add(where, fmt::format("is {}; the axis, its first three numbers, must not be 0", brief(json)));
  return {};
}

class MotionReader {
 public:
  MotionReader(const Json& json, std::string where, Findings& findings)
      : json_(json),
        where_(std::move(where)),
        findings_(findings) {}

  // Empty where the motion is wrong.
  std::optional<Motion> read() const {
    const bool steady = json_.contains("velocity") || json_.contains("angular_velocity");
    const bool keyed = json_.contains("keyframes"), swings = json_.contains("oscillate");
    if (int{steady} + int{keyed} + int{swings} > 1) {
      findings_.add(where_,
                    "moves in several ways; give \"velocity\" and \"angular_velocity\", or \"keyframes\", or "
                    "\"oscillate\"");
      return {};
    }
    if (swings && json_.contains("pivot")) {
      findings_.add(join_path(where_, "pivot"), "is of no use to \"oscillate\", which does not turn");
      return {};
    }
    if (keyed) return keyframes();
    if (swings) return oscillation();
    return Motion(SteadyMotion{vector(json_, "velocity"), vector(json_, "angular_velocity"), pivot()});
  }

 private:
  static Vec3d vector(const Json& json, const char* key) {
    return json.contains(key) ? vec3_or(json.at(key), {}) : Vec3d{0, 0, 0};
  }
  std::optional<Vec3d> pivot() const {
    if (!json_.contains("pivot")) return {};
    return vector(json_, "pivot");
  }

  std::optional<Motion> keyframes() const {
    KeyframeMotion motion;
    motion.pivot = pivot();
    const Json& all = json_.at("keyframes");
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::string at = join_path(join_path(where_, "keyframes"), i);
      const auto rotation = rotation_of(all[i].at("rotation"), join_path(at, "rotation"), findings_);
      if (rotation)
        motion.keyframes.push_back({all[i].at("time").get<double>(), vector(all[i], "position"), *rotation});
    }
    if (motion.keyframes.size() < all.size()) return {};
    return Motion(std::move(motion));
  }

  std::optional<Motion> oscillation() const {
    const Json& json = json_.at("oscillate");
    return Motion(Oscillation{vector(json, "amplitude"), json.at("frequency").get<double>(),
                              json.at("phase").get<double>() / 360});
  }

  const Json& json_;
  std::string where_;
  Findings& findings_;
};

}  // namespace

std::optional<Motion> read_motion(const Json& entry, const std::string& where, Findings& findings) {
  const std::string path = join_path(where, "motion");
  if (!entry.contains("motion") || findings.touches(path)) return Motion(NoMotion{});
  return MotionReader(entry.at("motion"), path, findings).read();
}

void build_colliders(Json& colliders, const ShapeFiles& files, Scene& scene, Findings& findings) {
  for (std::size_t i = 0; i < colliders.size(); ++i) {
    const std::string where = join_path("colliders", i);
    Json& json = colliders[i];
    if (!json.is_object()) continue;
    Collider collider;
    if (!json.contains("name")) json["name"] = fmt::format("collider_{}", i + 1);
    if (json.contains("material") && !findings.touches(join_path(where, "material"))) {
      collider.material = material_named(json.at("material").get<std::string>(), join_path(where, "material"),
                                         scene.materials, findings);
    }
    std::optional<Motion> motion = read_motion(json, where, findings);
    std::optional<Shape> shape;
    ShapeFiles meshes = files;
    if (json.contains("hollow") && json.at("hollow") == true) meshes.depth = 1;  // touched from both sides
    if (json.contains("shape")) shape = read_shape(json.at("shape"), join_path(where, "shape"), meshes, findings);
    if (!shape || !motion || findings.touches(where)) continue;
    collider.name = json.at("name").get<std::string>();
    collider.shape = std::move(*shape);
    collider.hollow = json.at("hollow").get<bool>();
    collider.motion = std::move(*motion);
    scene.colliders.push_back(std::move(collider));
  }
}

}  // namespace hooke::scene
