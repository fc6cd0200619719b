// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/picture_builder.h"

#include <fmt/format.h>

#include <algorithm>

#include "hooke/base/printable.h"
#include "hooke/scene/json_path.h"
#include "hooke/scene/material_names.h"
#include "hooke/scene/scene_builder.h"
#include "hooke/scene/spelling.h"

namespace hooke::scene {
namespace {

// Reads the members of an object at a path, without those that have a finding.
class Members {
 public:
  Members(const Json& json, std::string where, const Findings& findings)
      : json_(json),
        where_(std::move(where)),
        findings_(findings) {}

  std::optional<Vec3d> point(const char* key) const {
    if (!has(key)) return {};
    return vec3_or(json_.at(key), {});
  }
  std::optional<double> number(const char* key) const {
    if (!has(key)) return {};
    return json_.at(key).get<double>();
  }
  void read(const char* key, double& value) const { value = number(key).value_or(value); }
  void read(const char* key, bool& value) const {
    if (has(key)) value = json_.at(key).get<bool>();
  }
  void read(const char* key, std::string& value) const {
    if (has(key)) value = json_.at(key).get<std::string>();
  }

 private:
  bool has(const char* key) const { return json_.contains(key) && !findings_.touches(join_path(where_, key)); }

  const Json& json_;
  std::string where_;
  const Findings& findings_;
};

std::optional<std::size_t> collider_named(const std::string& name, const std::vector<Collider>& colliders,
                                          Findings& findings) {
  const auto found =
      std::find_if(colliders.begin(), colliders.end(), [&](const Collider& c) { return c.name == name; });
  if (found != colliders.end()) return static_cast<std::size_t>(found - colliders.begin());
  std::vector<std::string> names;
  for (const Collider& c : colliders) names.push_back(c.name);
  const std::string hint = did_you_mean(name, names);
  findings.add("camera.follow.collider",
               fmt::format("is \"{}\", which is no collider{}{} the scene has {}", printable(name, 60), hint,
                           hint.empty() ? ";" : "", names.empty() ? "none" : quoted_list(names)));
  return {};
}

}  // namespace

void build_camera(const Json& json, Scene& scene, Findings& findings) {
  if (!json.is_object()) return;
  SceneCamera& camera = scene.camera;
  const Members own(json, "camera", findings);
  camera.eye = own.point("eye");
  camera.target = own.point("target");
  own.read("field_of_view", camera.field_of_view);
  own.read("orbit", camera.orbit);
  own.read("roll", camera.roll);
  if (json.contains("keyframes") && !findings.touches("camera.keyframes")) {
    for (std::size_t i = 0; i < json.at("keyframes").size(); ++i) {
      const Members key(json.at("keyframes")[i], join_path("camera.keyframes", i), findings);
      camera.keyframes.push_back({key.number("time").value_or(0), key.point("eye"), key.point("target"),
                                  key.number("field_of_view"), key.number("roll")});
    }
  }
  if (json.contains("follow") && !findings.touches("camera.follow")) {
    const Json& follow = json.at("follow");
    CameraFollow what;
    if (follow.contains("material")) {
      what.material =
          material_named(follow.at("material").get<std::string>(), "camera.follow.material", scene.materials, findings);
    } else {
      what.collider = collider_named(follow.at("collider").get<std::string>(), scene.colliders, findings);
    }
    if (what.material || what.collider) camera.follow = what;
  }
}

void build_picture(const Json& json, Scene& scene, const Findings& findings) {
  if (!json.is_object()) return;
  ScenePicture& picture = scene.picture;
  const Members own(json, "picture", findings);
  own.read("box", picture.box);
  own.read("ground", picture.ground);
  own.read("ground_lines", picture.ground_lines);
  own.read("ground_color", picture.ground_color);
  own.read("background", picture.background);
  picture.sun = own.point("sun");
  own.read("sunlight", picture.sunlight);
  own.read("skylight", picture.skylight);
  std::string springs;
  own.read("springs", springs);
  if (springs == "rods") picture.springs = SpringLook::rods;
  if (springs == "strain") picture.springs = SpringLook::strain;
}

}  // namespace hooke::scene
