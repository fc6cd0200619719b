// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/physics/stability.h"

#include <fmt/format.h>

#include <algorithm>

#include "hooke/core/simulation.h"

namespace hooke {
namespace {

// The step at which a pile with these coefficients, of pairs of effective mass `m_eff`, becomes unstable.
double pile_step(const ContactCoefficients<double>& c, double m_eff) {
  return critical_step(kPileSpringFactor * c.stiffness / m_eff, kPileDampingFactor * (c.shear + c.damping) / m_eff);
}

std::string limiting(const ContactCoefficients<double>& c, double m_eff, const std::string& pair) {
  const double by_spring = critical_step(kPileSpringFactor * c.stiffness / m_eff, 0);
  const double by_dashpots = critical_step(0, kPileDampingFactor * (c.shear + c.damping) / m_eff);
  const char* which = by_spring < by_dashpots / 4   ? "stiffness"
                      : by_dashpots < by_spring / 4 ? "shear and damping"
                                                    : "stiffness, shear and damping";
  return fmt::format("{} of {}", which, pair);
}

}  // namespace

StableStep stable_step(const Scene& scene) {
  const ContactTable table(scene.materials, scene.contacts);
  StableStep best{INFINITY, "nothing"};
  const auto consider = [&](const ContactCoefficients<double>& c, double m_eff, const std::string& pair) {
    const double seconds = pile_step(c, m_eff);
    if (seconds < best.seconds) best = {seconds, limiting(c, m_eff, pair)};
  };
  for (std::size_t a = 0; a < scene.materials.size(); ++a) {
    const Material& m = scene.materials[a];
    if (!m.is_of_particles()) continue;
    for (std::size_t b = a; b < scene.materials.size(); ++b) {
      const Material& n = scene.materials[b];
      if (!n.is_of_particles()) continue;
      consider(table.pair(a, b).linear, effective_mass(m.mass, n.mass), m.name + " - " + n.name);
    }
    // A wall is one partner that does not move, where a pile has a dozen that do.
    const auto consider_boundary = [&](const ContactCoefficients<double>& c, const std::string& boundary) {
      const double seconds = critical_step(c.stiffness / m.mass, (c.shear + c.damping) / m.mass);
      if (seconds < best.seconds) best = {seconds, fmt::format("stiffness and damping of {} - {}", m.name, boundary)};
    };
    consider_boundary(table.wall(a).linear, "wall");
    for (const Collider& collider : scene.colliders) {
      if (collider.material)
        consider_boundary(table.pair(a, *collider.material).linear, scene.materials[*collider.material].name);
    }
  }
  return best;
}

double momentum_drift(const Measurements& now, const Ledger& ledger, const Vec3d& initial_momentum) {
  const auto norm = [](const Vec3d& a) { return std::sqrt(dot(a, a)); };
  Vec3d given{0, 0, 0};
  double scale = now.momentum_scale + norm(initial_momentum) + norm(ledger.removed_momentum);
  for (const Vec3d& impulse : ledger.impulse.of) {
    given += impulse;
    scale += norm(impulse);
  }
  const Vec3d unexplained = now.momentum + ledger.removed_momentum - initial_momentum - given;
  return scale > 0 ? norm(unexplained) / scale : 0;
}

}  // namespace hooke
