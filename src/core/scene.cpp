// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/scene.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "hooke/base/assert.h"
#include "hooke/base/format.h"
#include "hooke/base/printable.h"

namespace hooke {
namespace {

constexpr const char* kAxisName[3] = {"x", "y", "z"};

// Collects what is wrong; `single` also asks that a value survive the rounding to float.
class Checker {
 public:
  explicit Checker(bool single) : single_(single) {}

  void finite(const std::string& where, double value) {
    if (!std::isfinite(value)) {
      add(where, formatted("{} is not a finite number", value));
    } else if (single_ && !std::isfinite(static_cast<float>(value))) {
      add(where, formatted("{} is beyond single precision (up to 3.4e38)", value));
    }
  }
  void positive(const std::string& where, double value) {
    finite(where, value);
    if (std::isfinite(value) && !(value > 0)) {
      add(where, formatted("{} must be greater than 0", value));
    } else if (std::isfinite(value) && single_ && !(static_cast<float>(value) > 0)) {
      add(where, formatted("{} is 0 in single precision", value));
    }
  }
  void not_negative(const std::string& where, double value) {
    finite(where, value);
    if (std::isfinite(value) && value < 0) add(where, formatted("{} must be 0 or more", value));
  }
  void share(const std::string& where, double value) {
    if (!(value >= 0 && value <= 1)) add(where, formatted("{} must be from 0 to 1", value));
  }
  void coefficients(const std::string& where, const ContactCoefficients<double>& c) {
    not_negative(where + ".stiffness", c.stiffness);
    not_negative(where + ".shear", c.shear);
    not_negative(where + ".damping", c.damping);
  }
  void surface(const std::string& where, const SurfaceCoefficients<double>& s) {
    if (!std::isinf(s.friction)) not_negative(where + ".friction", s.friction);
    if (!std::isinf(s.tension)) not_negative(where + ".tension", s.tension);
    not_negative(where + ".cohesion.strength", s.cohesion);
    not_negative(where + ".cohesion.range", s.range);
  }
  void add(std::string where, std::string message) { findings.push_back({std::move(where), std::move(message)}); }

  std::vector<Finding> findings;

 private:
  bool single_;
};

void check_domain(const Domain& domain, bool single, Checker& check) {
  for (int axis = 0; axis < 3; ++axis) {
    const double low = component(domain.min, axis);
    const double high = component(domain.max, axis);
    check.finite(formatted("domain.min[{}]", axis), low);
    check.finite(formatted("domain.max[{}]", axis), high);
    if (!std::isfinite(low) || !std::isfinite(high)) continue;
    const bool empty = single ? !(static_cast<float>(low) < static_cast<float>(high)) : !(low < high);
    if (empty) {
      check.add(formatted("domain.max[{}]", axis),
                formatted("{} must be greater than domain.min[{}] = {} ({} axis){}", high, axis, low, kAxisName[axis],
                          low < high ? ", also after rounding to single precision" : ""));
    }
  }
}

// A shorter period would need many images of a particle; no real domain is that small.
void check_periods(const Scene& scene, Checker& check) {
  double largest = 0;
  for (const Material& m : scene.materials) largest = std::max(largest, m.radius);
  for (int axis = 0; axis < 3; ++axis) {
    if (scene.domain.boundary[static_cast<std::size_t>(axis)] != Boundary::periodic) continue;
    const double length = scene.domain.length(axis);
    if (std::isfinite(length) && length > 0 && length < largest) {
      check.add(formatted("domain.max[{}]", axis),
                formatted("the periodic {} axis is {} m long, less than the largest radius {} m", kAxisName[axis],
                          length, largest));
    }
  }
}

void check_materials(const Scene& scene, Checker& check) {
  if (scene.materials.size() > kMostMaterials) {
    check.add("materials", formatted("{} materials, at most {} are possible", scene.materials.size(), kMostMaterials));
  }
  std::set<std::string> names;
  for (const Material& m : scene.materials) {
    const std::string where = "materials" + path_step(m.name);
    if (m.name == "wall") check.add(where, "\"wall\" is reserved for the domain's walls; choose another name");
    if (!names.insert(m.name).second) check.add(where, "a second material of this name");
    if (m.is_of_particles() || m.radius != 0 || m.mass != 0) {
      check.positive(where + ".radius", m.radius);
      check.positive(where + ".mass", m.mass);
    }
    check.coefficients(where, m.contact);
    check.surface(where, m.surface);
    check.not_negative(where + ".drag", m.drag);
    check.not_negative(where + ".foam", m.foam);
    check.share(where + ".opacity", m.opacity);
    check.share(where + ".roughness", m.roughness);
  }
}

void check_contacts(const Scene& scene, Checker& check) {
  std::set<std::pair<std::size_t, std::size_t>> seen;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const ContactEntry& entry = scene.contacts[i];
    const std::string where = formatted("contacts[{}]", i);
    const bool known =
        entry.a < scene.materials.size() && (entry.b < scene.materials.size() || entry.b == ContactEntry::kWall);
    if (!known) check.add(where + ".between", "names a material that does not exist");
    const auto pair = entry.b == ContactEntry::kWall
                          ? std::pair{entry.a, entry.b}
                          : std::pair{std::min(entry.a, entry.b), std::max(entry.a, entry.b)};
    if (!seen.insert(pair).second) check.add(where + ".between", "a second entry for the same pair");
    check.coefficients(where, entry.coefficients);
    check.surface(where, entry.surface);
  }
}

}  // namespace

const char* to_string(Integrator integrator) {
  return integrator == Integrator::symplectic_euler ? "symplectic-euler" : "velocity-verlet";
}

const char* to_string(Precision precision) { return precision == Precision::single_precision ? "single" : "double"; }

bool OutputCadence::is_due(std::int64_t step, double dt) const {
  HOOKE_ASSERT(step >= 0 && dt > 0, step, dt);
  HOOKE_ASSERT(seconds >= 0 && steps >= 0, seconds, steps);
  if (step == 0) return true;
  if (steps > 0) return step % steps == 0;
  if (!(seconds > 0)) return false;
  // Which multiple of `seconds` the state at t = step dt has reached. The relative 1e-9 keeps a multiple that falls
  // on a step there, although neither number need be exact in binary.
  const auto reached = [&](std::int64_t n) {
    const double multiples = static_cast<double>(n) * dt / seconds;
    return std::floor(multiples * (1 + 1e-9) + 1e-9);
  };
  return reached(step) > reached(step - 1);
}

std::vector<Finding> validate(const Scene& scene) {
  const bool single = scene.precision == Precision::single_precision;
  Checker check(single);
  check.positive("time.step", scene.time_step);
  if (scene.steps < 0) check.add("time.steps", formatted("{} must be 0 or more", scene.steps));
  for (int axis = 0; axis < 3; ++axis) check.finite(formatted("gravity[{}]", axis), component(scene.gravity, axis));
  check_domain(scene.domain, single, check);
  check_periods(scene, check);
  check_materials(scene, check);
  check_contacts(scene, check);
  for (Finding& finding : check_colliders(scene)) check.findings.push_back(std::move(finding));
  for (Finding& finding : check_emitters(scene)) check.findings.push_back(std::move(finding));
  check.not_negative("output.every", scene.output.seconds);
  if (scene.output.steps < 0) check.add("output.every_steps", formatted("{} must be 1 or more", scene.output.steps));
  for (Finding& finding : validate(scene.camera)) check.findings.push_back(std::move(finding));
  for (Finding& finding : validate(scene.picture)) check.findings.push_back(std::move(finding));
  for (Finding& finding : check_fields(scene)) check.findings.push_back(std::move(finding));
  for (Finding& finding : validate_attraction(scene)) check.findings.push_back(std::move(finding));
  if (scene.structure) {
    for (Finding& finding : validate(*scene.structure, single)) check.findings.push_back(std::move(finding));
  }
  if (check.findings.empty()) check.findings = check_places_of_birth(scene);
  return check.findings;
}

}  // namespace hooke
