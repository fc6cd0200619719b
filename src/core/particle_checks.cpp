// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/particle_checks.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "hooke/base/format.h"
#include "hooke/base/printable.h"

namespace hooke {
namespace {

bool wants_accelerations(const Scene& scene, bool restored) {
  return restored && scene.integrator == Integrator::velocity_verlet;
}

Finding unequal_columns(std::size_t ids, std::size_t materials, std::size_t positions, std::size_t velocities,
                        std::size_t accelerations) {
  return {"particles", formatted("columns of different length: {} ids, {} materials, {} positions, {} velocities, "
                                 "{} accelerations",
                                 ids, materials, positions, velocities, accelerations)};
}

// Looks at particles a slice after the other.
class ParticleCheck {
 public:
  ParticleCheck(const Scene& scene, bool restored) : scene_(scene), restored_(restored) {}

  void add(const ParticleSlice& slice) {
    if (slice.size() == 0) return;
    check_ids(slice.id);
    for (std::size_t i = 0; i < slice.size() && faults_.size() < kMostFindings; ++i) {
      std::string fault = particle_fault(scene_, slice.material[i], slice.position[i], slice.velocity[i]);
      // A particle that presses against a wall may stand outside when a state is saved; it comes back.
      if (restored_ && fault.find("outside the domain") != std::string::npos) continue;
      if (!fault.empty()) faults_.push_back({formatted("particle {}", slice.id[i]), std::move(fault)});
    }
  }

  std::uint64_t largest_id() const { return last_id_; }

  // The fault of the ids first.
  std::vector<Finding> findings() && {
    if (!id_fault_ && last_id_ == ~std::uint64_t{0})
      id_fault_ = Finding{"particles", "the largest 64-bit id is reserved"};
    if (id_fault_) faults_.insert(faults_.begin(), std::move(*id_fault_));
    if (faults_.size() > kMostFindings) faults_.resize(kMostFindings);
    return std::move(faults_);
  }

 private:
  void check_ids(std::span<const std::uint64_t> ids) {
    for (const std::uint64_t id : ids) {
      if (!is_first_ && last_id_ >= id && !id_fault_) {
        id_fault_ = Finding{"particles", formatted("ids must be unique and ascending: {} follows {}", id, last_id_)};
      }
      last_id_ = id;
      is_first_ = false;
    }
  }

  const Scene& scene_;
  bool restored_;
  bool is_first_ = true;
  std::uint64_t last_id_ = 0;
  std::optional<Finding> id_fault_;
  std::vector<Finding> faults_;
};

}  // namespace

bool is_inside(const Domain& domain, const Vec3d& x) {
  for (int axis = 0; axis < 3; ++axis) {
    const double value = component(x, axis);
    if (!(value >= component(domain.min, axis) && value <= component(domain.max, axis))) return false;
  }
  return true;
}

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
  const std::size_t n = p.size();
  if (p.material.size() != n || p.position.size() != n || p.velocity.size() != n ||
      (wants_accelerations(scene, restored) && p.acceleration.size() != n)) {
    return {unequal_columns(n, p.material.size(), p.position.size(), p.velocity.size(), p.acceleration.size())};
  }
  ParticleSlice all;
  all.id = p.id;
  all.material = p.material;
  all.position = p.position;
  all.velocity = p.velocity;
  ParticleCheck check(scene, restored);
  check.add(all);
  return std::move(check).findings();
}

Expected<std::vector<Finding>> check_particles(const Scene& scene, const ParticleSlices& particles, bool restored,
                                               std::uint64_t& largest_id) {
  constexpr std::size_t kRows = std::size_t{1} << 16U;
  largest_id = 0;
  const std::size_t n = particles.size();
  if (n > 0 && wants_accelerations(scene, restored) && !particles.has_accelerations())
    return std::vector<Finding>{unequal_columns(n, n, n, n, 0)};
  ParticleCheck check(scene, restored);
  auto visited = particles.visit(kRows, [&check](const ParticleSlice& slice) { check.add(slice); });
  if (!visited) return fail(std::move(visited).error());
  largest_id = check.largest_id();
  return std::move(check).findings();
}

}  // namespace hooke
