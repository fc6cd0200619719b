// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/field_builder.h"

#include "hooke/scene/json_path.h"
#include "hooke/scene/material_names.h"
#include "hooke/scene/scene_builder.h"

namespace hooke::scene {
namespace {

constexpr double kPedestriansTime = 0.5;  // s, in which people adapt their speed (Helbing and Molnar 1995)

Vec3d vector(const Json& json, const char* key) { return vec3_or(json.at(key), {}); }

Wind read_wind(const Json& json) {
  Wind wind;
  wind.velocity = vector(json, "velocity");
  if (json.contains("drag")) wind.drag = json.at("drag").get<double>();
  wind.area_drag = json.at("area_drag").get<double>();
  if (!json.contains("gust")) return wind;
  const Json& gust = json.at("gust");
  wind.gust = Gust{vector(gust, "amplitude"), gust.at("frequency").get<double>(),
                   gust.contains("wavelength") ? gust.at("wavelength").get<double>() : 0};
  return wind;
}

PushToward read_toward(Json& json, const std::string& where, Findings& findings) {
  PushToward push{vector(json, "point"), json.at("acceleration").get<double>(), 0, 0};
  if (json.contains("speed")) {
    push.speed = json.at("speed").get<double>();
    if (!json.contains("time")) json["time"] = kPedestriansTime;
    push.time = json.at("time").get<double>();
  } else if (json.contains("time")) {
    findings.add(join_path(where, "time"), "is of no use without \"speed\", which it is the time to reach");
  }
  return push;
}

}  // namespace

void build_fields(Json& fields, Scene& scene, Findings& findings) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string where = join_path("fields", i);
    Field& field = scene.fields.emplace_back();
    if (findings.touches(where)) continue;
    Json& json = fields[i];
    if (json.contains("wind")) field.law = read_wind(json.at("wind"));
    if (json.contains("acceleration")) field.law = UniformPush{vector(json, "acceleration")};
    if (json.contains("toward")) field.law = read_toward(json.at("toward"), join_path(where, "toward"), findings);
    if (json.contains("within")) {
      const Json& box = json.at("within").at("box");
      field.within = BoxShape{vector(box, "min"), vector(box, "max")};
    }
    if (json.contains("materials")) {
      const Json& names = json.at("materials");
      for (std::size_t k = 0; k < names.size(); ++k) {
        const std::string at = join_path(join_path(where, "materials"), k);
        if (const auto m = material_named(names[k].get<std::string>(), at, scene.materials, findings)) {
          field.materials.push_back(*m);
        }
      }
    }
  }
}

}  // namespace hooke::scene
