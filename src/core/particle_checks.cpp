// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/particle_checks.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include "hooke/base/format.h"
#include "hooke/base/printable.h"

namespace hooke {
namespace {

bool is_inside(const Domain& domain, const Vec3d& x) {
  for (int axis = 0; axis < 3; ++axis) {
    const double value = component(x, axis);
    if (!(value >= component(domain.min, axis) && value <= component(domain.max, axis))) return false;
  }
  return true;
}

std::vector<Finding> check_columns(const ParticleSet& p, bool with_acceleration) {
  const std::size_t n = p.size();
  if (p.material.size() != n || p.position.size() != n || p.velocity.size() != n ||
      (with_acceleration && p.acceleration.size() != n)) {
    return {
        {"particles", formatted("columns of different length: {} ids, {} materials, {} positions, {} velocities, "
                                "{} accelerations",
                                n, p.material.size(), p.position.size(), p.velocity.size(), p.acceleration.size())}};
  }
  return {};
}

std::vector<Finding> check_ids(const ParticleSet& p) {
  for (std::size_t i = 1; i < p.size(); ++i) {
    if (p.id[i - 1] >= p.id[i]) {
      return {{"particles", formatted("ids must be unique and ascending: {} follows {}", p.id[i], p.id[i - 1])}};
    }
  }
  if (!p.empty() && p.id.back() == ~std::uint64_t{0}) return {{"particles", "the largest 64-bit id is reserved"}};
  return {};
}

}  // namespace

bool is_finite(const Vec3d& a, bool single) {
  const auto ok = [single](double v) { return single ? std::isfinite(static_cast<float>(v)) : std::isfinite(v); };
  return ok(a.x) && ok(a.y) && ok(a.z);
}

std::string shown(const Vec3d& a) { return formatted("({}, {}, {})", a.x, a.y, a.z); }

std::string particle_fault(const Scene& scene, std::size_t material, const Vec3d& x, const Vec3d& v) {
  const bool single = scene.precision == Precision::single_precision;
  if (material >= scene.materials.size()) {
    return formatted("material {} does not exist; there are {}", material, scene.materials.size());
  }
  if (!scene.materials[material].is_of_particles()) {
    return formatted("material \"{}\" has no radius and no mass: only colliders may have it",
                     printable(scene.materials[material].name));
  }
  if (!is_finite(x, single)) return "position " + shown(x) + " is not finite";
  if (!is_finite(v, single)) return "velocity " + shown(v) + " is not finite";
  if (!is_inside(scene.domain, x)) {
    return formatted("position {} is outside the domain {} to {}", shown(x), shown(scene.domain.min),
                     shown(scene.domain.max));
  }
  return {};
}

std::vector<Finding> check_particles(const Scene& scene, const ParticleSet& p, bool restored) {
  std::vector<Finding> findings = check_columns(p, restored && scene.integrator == Integrator::velocity_verlet);
  if (!findings.empty()) return findings;
  findings = check_ids(p);
  for (std::size_t i = 0; i < p.size() && findings.size() < kMostFindings; ++i) {
    std::string fault = particle_fault(scene, p.material[i], p.position[i], p.velocity[i]);
    // A particle that presses against a wall may stand outside when a state is saved; it comes back.
    if (restored && fault.find("outside the domain") != std::string::npos) continue;
    if (!fault.empty()) findings.push_back({formatted("particle {}", p.id[i]), std::move(fault)});
  }
  return findings;
}

}  // namespace hooke
