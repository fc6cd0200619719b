// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/structure_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hooke/base/assert.h"
#include "hooke/physics/periodic.h"
#include "hooke/scene/available_memory.h"
#include "hooke/scene/json_path.h"
#include "hooke/scene/material_names.h"

namespace hooke::scene {

std::optional<std::uint16_t> StructureMaker::material_of(const Json& entry, const std::string& path) {
  const std::string where = join_path(path, "material");
  if (findings.touches(where) || !entry.contains("material")) return std::nullopt;
  const auto& name = entry.at("material").get_ref<const std::string&>();
  const auto m = material_named(name, where, scene.materials, findings);
  if (!m) return std::nullopt;
  if (scene.materials[*m].is_of_particles()) return static_cast<std::uint16_t>(*m);
  findings.add(where, fmt::format("is \"{}\", which has neither radius nor mass: only colliders may have it",
                                  printable(name, 60)));
  return std::nullopt;
}

bool StructureMaker::fits(double particle_count, double spring_count, const std::string& path) {
  const double needed = (static_cast<double>(particles.size()) + particle_count) * kBytesPerParticle +
                        (static_cast<double>(structure.springs.size()) + spring_count) * kBytesPerSpring;
  const std::uint64_t limit = options.memory_limit != 0 ? options.memory_limit : available_memory();
  if (limit == 0 || needed <= static_cast<double>(limit)) return true;
  findings.add(path, fmt::format("is about {:.0f} particles and {:.0f} springs; all that there is then needs about {} "
                                 "of memory; {} are available",
                                 particle_count, spring_count, in_bytes(needed), in_bytes(static_cast<double>(limit))));
  return false;
}

std::uint64_t StructureMaker::add_particles(const std::vector<Vec3d>& positions, std::uint16_t material,
                                            const Vec3d& velocity, const std::string& path) {
  HOOKE_ASSERT(material < scene.materials.size(), material, scene.materials.size(), path);
  const std::uint64_t first = particles.empty() ? 1 : particles.id.back() + 1;
  std::uint64_t next = first;
  std::size_t outside = 0;
  Vec3d one{0, 0, 0};
  for (const Vec3d& x : positions) {
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis) {
      const double value = component(x, axis), max = component(scene.domain.max, axis);
      const bool periodic = scene.domain.boundary[static_cast<std::size_t>(axis)] == Boundary::periodic;
      inside = inside && value >= component(scene.domain.min, axis) && (periodic ? value < max : value <= max);
    }
    if (!inside && outside++ == 0) one = x;
    particles.id.push_back(next++);
    particles.material.push_back(material);
    particles.position.push_back(x);
    particles.velocity.push_back(velocity);
  }
  if (outside > 0 && !findings.touches("domain")) {
    const auto text = [](const Vec3d& x) { return fmt::format("[{}, {}, {}]", x.x, x.y, x.z); };
    findings.add(path, fmt::format("has {} of {} centres outside the domain {} to {}, one of them at {}", outside,
                                   positions.size(), text(scene.domain.min), text(scene.domain.max), text(one)));
  }
  return first;
}

void StructureMaker::end_group(const std::string& path) {
  std::vector<SpringGroup>& groups = structure.groups;
  const std::size_t end = structure.springs.size();
  if (end > (groups.empty() ? 0 : groups.back().end)) groups.push_back({path, end});
}

double StructureMaker::distance(std::uint64_t a, std::uint64_t b) const {
  const std::size_t i = particles.find(a), k = particles.find(b);
  HOOKE_ASSERT(i < particles.size() && k < particles.size(), a, b, particles.size());
  const Vec3d d = nearest_displacement(particles.position[i], particles.position[k], scene.domain.period());
  return std::sqrt(dot(d, d));
}

double break_strain_of(const Json& entry) {
  return entry.contains("break_strain") ? entry.at("break_strain").get<double>()
                                        : std::numeric_limits<double>::infinity();
}

std::shared_ptr<const Structure> load_structure(const Json& json, const Scene& scene,
                                                const std::filesystem::path& folder, const LoadOptions& options,
                                                Findings& findings, ParticleSet& particles,
                                                std::vector<Finding>& warnings, FieldMemory& fields) {
  StructureMaker maker{scene, folder, options, findings, particles, warnings, fields};
  const auto section = [&](const char* key, void (StructureMaker::*add)(const Json&)) {
    const auto entries = json.find(key);
    if (entries != json.end() && entries->is_array()) (maker.*add)(*entries);
  };
  section("cloths", &StructureMaker::add_cloths);
  section("bodies", &StructureMaker::add_bodies);
  section("springs", &StructureMaker::add_springs);
  if (maker.structure == Structure{}) return nullptr;
  std::vector<std::uint64_t>& pinned = maker.structure.pinned;
  std::sort(pinned.begin(), pinned.end());
  pinned.erase(std::unique(pinned.begin(), pinned.end()), pinned.end());
  return std::make_shared<Structure>(std::move(maker.structure));
}

}  // namespace hooke::scene
