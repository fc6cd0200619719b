// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "action.h"

#include <fmt/format.h>

#include <array>
#include <exception>
#include <type_traits>

namespace hooke::view {
namespace {

// In the order of the variant.
constexpr std::array<const char*, std::variant_size_v<Action>> kNames = {
    "add-ball", "hold-collider", "hold-particles",  "lead",        "let-go", "cut-springs",
    "scatter",  "reset",         "load-checkpoint", "change-scene"};

scene::Json vector_json(const Vec3d& v) { return scene::Json::array({v.x, v.y, v.z}); }

Vec3d vector_at(const scene::Json& json, const char* key) {
  const auto values = json.at(key).get<std::array<double, 3>>();
  return {values[0], values[1], values[2]};
}

struct Writer {
  scene::Json& out;
  void operator()(const AddBall& a) const {
    out["material"] = a.material;
    out["center"] = vector_json(a.center);
    out["radius"] = a.radius;
    out["velocity"] = vector_json(a.velocity);
  }
  void operator()(const HoldCollider& a) const {
    out["name"] = a.name;
    out["rotation"] = vector_json(a.rotation);
  }
  void operator()(const HoldParticles& a) const { out["ids"] = a.ids; }
  void operator()(const Lead& a) const { out["shift"] = vector_json(a.shift); }
  void operator()(const LetGo&) const {}
  void operator()(const CutSprings& a) const { out["springs"] = a.springs; }
  void operator()(const Scatter& a) const { out["seed"] = a.seed; }
  void operator()(const Reset&) const {}
  void operator()(const LoadCheckpoint& a) const { out["file"] = a.file; }
  void operator()(const ChangeScene& a) const { out["patch"] = a.patch; }
};

Action read(const scene::Json& json, const std::string& name) {
  if (name == "add-ball") {
    return AddBall{json.at("material").get<std::string>(), vector_at(json, "center"), json.at("radius").get<double>(),
                   vector_at(json, "velocity")};
  }
  if (name == "hold-collider") return HoldCollider{json.at("name").get<std::string>(), vector_at(json, "rotation")};
  if (name == "hold-particles") return HoldParticles{json.at("ids").get<std::vector<std::uint64_t>>()};
  if (name == "lead") return Lead{vector_at(json, "shift")};
  if (name == "let-go") return LetGo{};
  if (name == "cut-springs") return CutSprings{json.at("springs").get<std::vector<std::uint64_t>>()};
  if (name == "scatter") return Scatter{json.at("seed").get<std::uint64_t>()};
  if (name == "reset") return Reset{};
  if (name == "load-checkpoint") return LoadCheckpoint{json.at("file").get<std::string>()};
  return ChangeScene{json.at("patch")};
}

}  // namespace

const char* name_of(const Action& action) { return kNames[action.index()]; }

scene::Json to_json(const Action& action) {
  scene::Json json = scene::Json::object();
  json["do"] = name_of(action);
  std::visit(Writer{json}, action);
  return json;
}

Expected<Action> action_from_json(const scene::Json& json) {
  try {
    const auto name = json.at("do").get<std::string>();
    for (const char* known : kNames) {
      if (name == known) return read(json, name);
    }
    return fail(Error::Kind::bad_input, "do", fmt::format("\"{}\" is no action", printable(name)));
  } catch (const nlohmann::json::exception& thrown) {
    return fail(Error::Kind::bad_input, "action", thrown.what());
  }
}

}  // namespace hooke::view
