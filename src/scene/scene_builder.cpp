// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/scene_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "hooke/scene/attraction_builder.h"
#include "hooke/scene/collider_builder.h"
#include "hooke/scene/emitter_builder.h"
#include "hooke/scene/field_builder.h"
#include "hooke/scene/json_path.h"
#include "hooke/scene/picture_builder.h"
#include "hooke/scene/spelling.h"

namespace hooke::scene {
namespace {

constexpr std::int64_t kMostSteps = 9007199254740992;  // 2^53: step * dt still has an exact step

// The member `key` of an object; null where there is none.
const Json& member(const Json& object, const char* key) {
  static const Json nothing;
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found == object.end() ? nothing : *found;
}

double number_or(const Json& value, double fallback) { return value.is_number() ? value.get<double>() : fallback; }

std::int64_t count_or(const Json& value, std::int64_t fallback) {
  return value.is_number_integer() ? value.get<std::int64_t>() : fallback;
}

std::string text_or(const Json& value, const std::string& fallback) {
  return value.is_string() ? value.get<std::string>() : fallback;
}

// The first step at or after `end`, where t = step * dt; the quotient of two decimal numbers may miss a whole number by
// rounding.
double steps_until(double end, double dt) {
  const double quotient = end / dt;
  const double nearest = std::round(quotient);
  return std::abs(quotient - nearest) <= 1e-9 * std::max(1.0, std::min(nearest, 1e3)) ? nearest : std::ceil(quotient);
}

void build_time(const Json& time, Scene& scene, Findings& findings) {
  if (!findings.touches("time.step")) scene.time_step = number_or(member(time, "step"), scene.time_step);
  if (text_or(member(time, "integrator"), "") == "velocity-verlet") scene.integrator = Integrator::velocity_verlet;
  scene.steps = count_or(member(time, "steps"), 0);
  if (member(time, "end").is_number() && !findings.touches("time.end") && !findings.touches("time.step")) {
    const double steps = steps_until(time.at("end").get<double>(), scene.time_step);
    if (steps > static_cast<double>(kMostSteps)) {
      findings.add("time.end",
                   fmt::format("is {}, {:.3g} steps; at most 2^53 are possible", brief(time.at("end")), steps));
    } else {
      scene.steps = static_cast<std::int64_t>(steps);
    }
  }
}

Boundary boundary_of(const Json& name) {
  return name == "open" ? Boundary::open : name == "periodic" ? Boundary::periodic : Boundary::spring;
}

void build_domain(const Json& domain, Scene& scene, const Findings& findings) {
  // One corner without the other would only lead to false findings.
  if (!findings.touches("domain.min") && !findings.touches("domain.max")) {
    scene.domain.min = vec3_or(member(domain, "min"), scene.domain.min);
    scene.domain.max = vec3_or(member(domain, "max"), scene.domain.max);
  }
  const Json& walls = member(domain, "walls");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    scene.domain.boundary[axis] = boundary_of(walls.is_array() && axis < walls.size() ? walls[axis] : walls);
  }
}

// To be asked before anything is made of all materials, or of all pairs of them.
bool has_too_many_materials(const Json& materials, Findings& findings) {
  if (!materials.is_object() || materials.size() <= kMostMaterials) return false;
  if (!findings.touches_at("materials")) {
    findings.add("materials", fmt::format("has {} entries; at most {} are possible", materials.size(), kMostMaterials));
  }
  return true;
}

// The names of the materials that colliders have.
std::set<std::string_view> materials_of(const Json& colliders) {
  std::set<std::string_view> names;
  for (const Json& collider : colliders) {
    const Json& name = member(collider, "material");
    if (name.is_string()) names.insert(name.get_ref<const std::string&>());
  }
  return names;
}

// Both radius and mass may be left out where a collider has the material.
void find_size(const Json& entry, const std::string& where, bool of_collider, Material& material, Findings& findings) {
  const auto has = [&entry](const char* key) { return entry.contains(key); };
  if (!entry.is_object() || (has("radius") && has("mass"))) return;
  if (of_collider && !has("radius") && !has("mass")) {
    material.radius = material.mass = 0;
    return;
  }
  for (const auto& [key, unit] : {std::pair{"radius", "m"}, std::pair{"mass", "kg"}}) {
    if (!has(key)) findings.add(join_path(where, key), fmt::format("is missing; must be a number > 0 ({})", unit));
  }
}

// Reads friction, tension and cohesion of a material or of a pair; `fallback` replaces values left out or refused.
SurfaceCoefficients<double> read_surface(const Json& entry, const std::string& where,
                                         const SurfaceCoefficients<double>& fallback, const Findings& findings) {
  SurfaceCoefficients<double> surface = fallback;
  const auto given = [&](const char* key) { return entry.contains(key) && !findings.touches(join_path(where, key)); };
  if (given("friction")) surface.friction = entry.at("friction").get<double>();
  if (given("tension")) surface.tension = entry.at("tension").get<bool>() ? INFINITY : 0;
  if (given("cohesion")) {
    surface.cohesion = entry.at("cohesion").at("strength").get<double>();
    surface.range = entry.at("cohesion").at("range").get<double>();
  }
  return surface;
}

void build_materials(const Json& materials, const Json& colliders, Scene& scene, Findings& findings) {
  if (!materials.is_object()) return;
  const std::set<std::string_view> of_colliders = materials_of(colliders);
  for (const auto& [name, entry] : materials.items()) {
    Material material;
    material.name = name;
    const std::string where = join_path("materials", name);
    if (name.empty()) findings.add(where, "the name of a material must not be empty");
    // A value that the schema refused keeps its default: it has been reported.
    const auto value = [&, &values = entry](const char* key, double fallback) {
      return findings.touches(join_path(where, key)) ? fallback : number_or(member(values, key), fallback);
    };
    material.radius = value("radius", material.radius);
    material.mass = value("mass", material.mass);
    find_size(entry, where, of_colliders.count(name) > 0, material, findings);
    material.contact.stiffness = value("stiffness", 0);
    material.contact.shear = value("shear", 0);
    material.contact.damping = value("damping", 0);
    if (entry.is_object()) material.surface = read_surface(entry, where, material.surface, findings);
    material.drag = value("drag", 0);
    material.fixed = member(entry, "fixed") == true && !findings.touches(join_path(where, "fixed"));
    material.color = text_or(member(entry, "color"), "");
    if (member(entry, "look") == "water") material.look = MaterialLook::water;
    if (member(entry, "look") == "spark") material.look = MaterialLook::spark;
    if (member(entry, "look") == "skin") material.look = MaterialLook::skin;
    material.foam = value("foam", material.foam);
    material.opacity = value("opacity", material.opacity);
    material.roughness = value("roughness", material.roughness);
    if (member(entry, "interacts") == false) material.interacts = false;
    scene.materials.push_back(std::move(material));
  }
  // Materials of colliders alone come last, so that fewer numbers tell the particles' materials apart.
  std::stable_partition(scene.materials.begin(), scene.materials.end(),
                        [](const Material& m) { return m.is_of_particles(); });
}

// What the distance fields of meshes are needed for: the sizes of the particles.
ShapeFiles shape_files(const std::filesystem::path& folder, const LoadOptions& options, LoadedScene& loaded) {
  double smallest = INFINITY, largest = 0;
  for (const Material& m : loaded.scene.materials) {
    if (!m.is_of_particles()) continue;
    smallest = std::min(smallest, m.radius);
    largest = std::max(largest, m.radius);
  }
  if (std::isinf(smallest)) smallest = largest = 1;
  const double range = ContactTable(loaded.scene.materials, loaded.scene.contacts).widest_range();
  ShapeFiles files{folder, options.allow_outside, smallest, largest + range, &loaded.warnings, &loaded.files};
  files.memory_limit = options.memory_limit;
  files.memory = &loaded.fields;
  return files;
}

std::vector<std::string> names_of(const std::vector<Material>& materials) {
  std::vector<std::string> names;
  names.reserve(materials.size());
  for (const Material& m : materials) names.push_back(m.name);
  return names;
}

// Builds contacts; `index_of` gives the file's entry of each contact in the scene.
class ContactBuilder {
 public:
  ContactBuilder(Scene& scene, Findings& findings)
      : scene_(scene),
        findings_(findings),
        names_(names_of(scene.materials)) {}

  std::vector<std::size_t> index_of;

  void build(Json& contacts) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const std::string where = join_path("contacts", i);
      if (!contacts[i].is_object() || findings_.touches(join_path(where, "between"))) continue;
      ContactEntry entry;
      if (!find_pair(contacts[i].at("between"), where, entry)) continue;
      fill_coefficients(contacts[i], where, entry);
      scene_.contacts.push_back(entry);
      index_of.push_back(i);
    }
  }

 private:
  bool find_pair(const Json& between, const std::string& where, ContactEntry& entry) {
    std::size_t index[2];
    bool known = true;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::string name = between[k];
      const auto found = std::find(names_.begin(), names_.end(), name);
      index[k] = static_cast<std::size_t>(found - names_.begin());
      if (name == "wall") {
        index[k] = ContactEntry::kWall;
      } else if (found == names_.end()) {
        if (findings_.overflows()) return false;
        std::vector<std::string> allowed = names_;
        allowed.emplace_back("wall");
        const std::string hint = did_you_mean(name, allowed);
        findings_.add(join_path(join_path(where, "between"), k),
                      fmt::format("is \"{}\", which is no material{}{} the scene has {} and \"wall\"",
                                  printable(name, 60), hint, hint.empty() ? ";" : "", quoted_list(names_)));
        known = false;
      }
    }
    if (!known) return false;
    if (index[0] == ContactEntry::kWall) std::swap(index[0], index[1]);
    if (index[0] == ContactEntry::kWall) {
      findings_.add(join_path(where, "between"), "is \"wall\" twice; one of the two must be a material");
      return false;
    }
    entry.a = index[0];
    entry.b = index[1];
    return true;
  }

  void fill_coefficients(Json& json, const std::string& where, ContactEntry& entry) {
    const auto& a = scene_.materials[entry.a].contact;
    const auto mixed = entry.b == ContactEntry::kWall ? a : mix(a, scene_.materials[entry.b].contact);
    const auto fill = [&](const char* key, double& value, double fallback) {
      value = fallback;
      if (findings_.touches(join_path(where, key))) return;
      if (!json.contains(key)) json[key] = fallback;
      value = json.at(key).get<double>();
    };
    fill("stiffness", entry.coefficients.stiffness, mixed.stiffness);
    fill("shear", entry.coefficients.shear, mixed.shear);
    fill("damping", entry.coefficients.damping, mixed.damping);
    const auto& surface = scene_.materials[entry.a].surface;
    entry.surface = read_surface(
        json, where, entry.b == ContactEntry::kWall ? surface : mix(surface, scene_.materials[entry.b].surface),
        findings_);
  }

  Scene& scene_;
  Findings& findings_;
  std::vector<std::string> names_;
};

// For each list of the scene file: the file's entry of each element in the scene, since some entries were left out.
using EntriesOf = std::map<std::string, std::vector<std::size_t>>;

// Adds the faults that the core finds in the scene, where none has been reported yet.
void add_core_findings(const Scene& scene, const EntriesOf& entries_of, Findings& findings) {
  for (Finding& finding : validate(scene)) {
    const auto path = parse_path(finding.where);
    const auto entries =
        path && path->size() > 1 ? entries_of.find(std::get<std::string>(path->front())) : entries_of.end();
    if (entries != entries_of.end()) {
      JsonPath own = *path;
      own[1] = entries->second[std::get<std::size_t>(own[1])];
      finding.where = to_text(own);
    }
    if (!findings.touches(finding.where)) findings.add(finding.where, std::move(finding.message));
  }
}

}  // namespace

Vec3d vec3_or(const Json& value, const Vec3d& fallback) {
  if (!value.is_array() || value.size() != 3) return fallback;
  for (const Json& item : value) {
    if (!item.is_number()) return fallback;
  }
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

void build_scene(Json& json, const std::filesystem::path& folder, const LoadOptions& options, Findings& findings,
                 LoadedScene& loaded) {
  Scene& scene = loaded.scene;
  scene.name = text_or(member(json, "name"), "");
  build_time(member(json, "time"), scene, findings);
  if (member(json, "precision") == "double") scene.precision = Precision::double_precision;
  if (!findings.touches("gravity")) scene.gravity = vec3_or(member(json, "gravity"), scene.gravity);
  build_domain(member(json, "domain"), scene, findings);
  if (has_too_many_materials(member(json, "materials"), findings)) return;
  build_materials(member(json, "materials"), member(json, "colliders"), scene, findings);
  ContactBuilder contacts(scene, findings);
  if (member(json, "contacts").is_array()) contacts.build(json.at("contacts"));
  EntriesOf entries_of{{"contacts", contacts.index_of}};
  if (json.contains("attraction") && !findings.touches("attraction")) {
    scene.attraction = build_attraction(json.at("attraction"));
  }
  if (member(json, "fields").is_array()) build_fields(json.at("fields"), scene, findings);
  if (member(json, "colliders").is_array()) {
    build_colliders(json.at("colliders"), shape_files(folder, options, loaded), scene, findings);
  }
  if (member(json, "emitters").is_array()) {
    entries_of["emitters"] = build_emitters(json.at("emitters"), shape_files(folder, options, loaded), scene, findings);
  }
  if (member(json, "sinks").is_array()) {
    entries_of["sinks"] = build_sinks(json.at("sinks"), shape_files(folder, options, loaded), scene, findings);
  }
  if (!findings.touches("output")) {
    scene.output.seconds = number_or(member(json.at("output"), "every"), 0);
    scene.output.steps = count_or(member(json.at("output"), "every_steps"), 0);
  }
  build_camera(member(json, "camera"), scene, findings);
  build_picture(member(json, "picture"), scene, findings);
  add_core_findings(scene, entries_of, findings);
}

}  // namespace hooke::scene
