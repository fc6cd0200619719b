// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/emitter_builder.h"

#include <fmt/format.h>

#include "hooke/scene/collider_builder.h"
#include "hooke/scene/json_path.h"
#include "hooke/scene/material_names.h"
#include "hooke/scene/scene_builder.h"

namespace hooke::scene {
namespace {

// A number stands for the range from it to itself.
Range range_of(const Json& json) {
  if (json.is_number()) return {json.get<double>(), json.get<double>()};
  return {json[0].get<double>(), json[1].get<double>()};
}

// Emitters and sinks ask on which side of a surface a point is, not how far inside. An emitter can use an open mesh;
// for a sink an open mesh is an error. Neither needs a warning.
ShapeFiles for_places(ShapeFiles files) {
  files.depth = 1;
  files.opening = ShapeFiles::Opening::allowed;
  return files;
}

// Reads an emitter that has passed the schema.
Emitter read_emitter(const Json& json) {
  Emitter emitter;
  emitter.name = json.at("name").get<std::string>();
  emitter.rate = json.at("rate").get<double>();
  emitter.speed = range_of(json.at("speed"));
  emitter.direction = vec3_or(json.at("direction"), {});
  emitter.spread = json.at("spread").get<double>();
  if (json.contains("life")) emitter.life = range_of(json.at("life"));
  emitter.decay = range_of(json.at("decay"));
  emitter.start = json.at("start").get<double>();
  if (json.contains("stop")) emitter.stop = json.at("stop").get<double>();
  if (json.contains("count")) emitter.count = json.at("count").get<std::uint64_t>();
  emitter.respawn = json.at("respawn").get<bool>();
  emitter.seed = json.at("seed").get<std::uint64_t>();
  return emitter;
}

}  // namespace

std::vector<std::size_t> build_emitters(Json& emitters, const ShapeFiles& files, Scene& scene, Findings& findings) {
  const ShapeFiles meshes = for_places(files);
  std::vector<std::size_t> entries;
  for (std::size_t i = 0; i < emitters.size(); ++i) {
    const std::string where = join_path("emitters", i);
    Json& json = emitters[i];
    if (!json.is_object()) continue;
    if (!json.contains("name")) json["name"] = fmt::format("emitter_{}", i + 1);
    std::optional<std::size_t> material;
    if (json.contains("material") && !findings.touches(join_path(where, "material"))) {
      material = material_named(json.at("material").get<std::string>(), join_path(where, "material"), scene.materials,
                                findings);
    }
    std::optional<Motion> motion = read_motion(json, where, findings);
    std::optional<Shape> shape;
    if (json.contains("shape")) shape = read_shape(json.at("shape"), join_path(where, "shape"), meshes, findings);
    if (!shape || !motion || !material || findings.touches(where)) continue;
    Emitter emitter = read_emitter(json);
    emitter.material = *material;
    emitter.shape = std::move(*shape);
    emitter.motion = std::move(*motion);
    scene.emitters.push_back(std::move(emitter));
    entries.push_back(i);
  }
  return entries;
}

std::vector<std::size_t> build_sinks(const Json& sinks, const ShapeFiles& files, Scene& scene, Findings& findings) {
  const ShapeFiles meshes = for_places(files);
  std::vector<std::size_t> entries;
  for (std::size_t i = 0; i < sinks.size(); ++i) {
    const std::string where = join_path("sinks", i);
    if (!sinks[i].is_object() || !sinks[i].contains("shape")) continue;
    auto shape = read_shape(sinks[i].at("shape"), join_path(where, "shape"), meshes, findings);
    if (!shape) continue;
    scene.sinks.push_back({std::move(*shape)});
    entries.push_back(i);
  }
  return entries;
}

}  // namespace hooke::scene
