// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/snapshot.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "hooke/base/printable.h"
#include "hooke/io/failure.h"
#include "hooke/io/run_info_json.h"

namespace hooke::io {

std::vector<double> radii(const std::vector<MaterialInfo>& materials) {
  std::vector<double> all;
  for (const MaterialInfo& m : materials) all.push_back(m.radius);
  return all;
}

RunInfo describe_run(const Scene& scene, Precision precision) {
  RunInfo info{scene.name, scene.time_step, scene.integrator, precision, {}};
  info.materials.reserve(scene.materials.size());
  for (const Material& m : scene.materials) info.materials.push_back({m.name, m.radius, m.mass});
  for (const Collider& c : scene.colliders) info.colliders.push_back(c.name);
  return info;
}

RunInfo describe_run(const Simulation& simulation) {
  return describe_run(simulation.scene(), simulation.backend_info().precision);
}

std::string to_json(const RunInfo& info) {
  nlohmann::ordered_json json{{"scene", info.scene},
                              {"time_step", info.time_step},
                              {"integrator", to_string(info.integrator)},
                              {"precision", to_string(info.precision)},
                              {"materials", nlohmann::ordered_json::array()}};
  for (const MaterialInfo& m : info.materials) {
    json["materials"].push_back({{"name", m.name}, {"radius", m.radius}, {"mass", m.mass}});
  }
  if (!info.colliders.empty()) json["colliders"] = info.colliders;
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

RunInfo parse_run_info(const std::string& json, const std::filesystem::path& file) {
  try {
    const auto parsed = nlohmann::json::parse(json);
    RunInfo info;
    info.scene = parsed.at("scene").get<std::string>();
    info.time_step = parsed.at("time_step").get<double>();
    info.integrator = parsed.at("integrator").get<std::string>() == to_string(Integrator::velocity_verlet)
                          ? Integrator::velocity_verlet
                          : Integrator::symplectic_euler;
    info.precision = parsed.at("precision").get<std::string>() == to_string(Precision::double_precision)
                         ? Precision::double_precision
                         : Precision::single_precision;
    for (const auto& m : parsed.at("materials")) {
      info.materials.push_back(
          {m.at("name").get<std::string>(), m.at("radius").get<double>(), m.at("mass").get<double>()});
    }
    if (parsed.contains("colliders")) info.colliders = parsed.at("colliders").get<std::vector<std::string>>();
    return info;
  } catch (const nlohmann::json::exception&) {
    throw Failure(Error::Kind::bad_input, file, "is damaged: what it says of its run can't be read");
  }
}

std::vector<Finding> check_resumable(const RunInfo& checkpoint, const RunInfo& scene) {
  std::vector<Finding> findings;
  const auto differs = [&](const char* where, const auto& old_value, const auto& new_value) {
    if (old_value == new_value) return;
    findings.push_back({where, fmt::format("is {}, but the checkpoint's run has {}: it can't go on with the same bits",
                                           new_value, old_value)});
  };
  const auto names = [](const RunInfo& info) {
    std::string all;
    for (const MaterialInfo& m : info.materials) all += (all.empty() ? "" : ", ") + printable(m.name);
    return all;
  };
  differs("time.step", checkpoint.time_step, scene.time_step);
  differs("time.integrator", std::string(to_string(checkpoint.integrator)), std::string(to_string(scene.integrator)));
  differs("precision", std::string(to_string(checkpoint.precision)), std::string(to_string(scene.precision)));
  differs("materials", names(checkpoint), names(scene));
  return findings;
}

}  // namespace hooke::io
