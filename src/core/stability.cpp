// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/physics/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hooke/core/simulation.h"

namespace hooke {
namespace {

// Of two coefficients that limit a step together, the one that would limit it to much the same by itself.
const char* limiting(double omega2, double gamma, const char* spring, const char* dashpot, const char* both) {
  const double by_spring = critical_step(omega2, 0), by_dashpot = critical_step(0, gamma);
  if (by_spring < by_dashpot / 4) return spring;
  if (by_dashpot < by_spring / 4) return dashpot;
  return both;
}

// The smallest step so far.
class Smallest {
 public:
  // The modes of a pile with these coefficients, of pairs of effective mass `m_eff`.
  void consider_pile(const ContactCoefficients<double>& c, double m_eff, const std::string& pair) {
    const double omega2 = kPileSpringFactor * c.stiffness / m_eff;
    const double gamma = kPileDampingFactor * (c.shear + c.damping) / m_eff;
    if (!is_smaller(omega2, gamma)) return;
    step.limit = fmt::format(
        "{} of {}", limiting(omega2, gamma, "stiffness", "shear and damping", "stiffness, shear and damping"), pair);
  }
  // A wall is one partner that does not move, where a pile has a dozen that do.
  void consider_boundary(const ContactCoefficients<double>& c, double mass, const std::string& pair) {
    if (is_smaller(c.stiffness / mass, (c.shear + c.damping) / mass)) step.limit = "stiffness and damping of " + pair;
  }
  void consider_drag(double drag, const Material& m) {
    if (is_smaller(0, drag / m.mass)) step.limit = "drag of " + m.name;
  }
  // The springs that tie one particle, K and C in all. No mode of particles and springs is faster than
  // omega^2 = 2 K/m, gamma = 2 C/m of the one for which that is most: (u_i - u_p)^2 <= 2 (u_i^2 + u_p^2) for each.
  void consider_springs(double stiffness, double damping, const Material& m, std::uint64_t id) {
    const double omega2 = 2 * stiffness / m.mass, gamma = 2 * damping / m.mass;
    if (!is_smaller(omega2, gamma)) return;
    step.limit = fmt::format("{} of the springs around particle {} ({})",
                             limiting(omega2, gamma, "stiffness", "damping", "stiffness and damping"), id, m.name);
  }

  StableStep step{INFINITY, "nothing"};

 private:
  bool is_smaller(double omega2, double gamma) {
    const double seconds = critical_step(omega2, gamma);
    if (!(seconds < step.seconds)) return false;
    step.seconds = seconds;
    return true;
  }
};

void consider_contacts(const Scene& scene, Smallest& smallest) {
  const ContactTable table(scene.materials, scene.contacts);
  for (std::size_t a = 0; a < scene.materials.size(); ++a) {
    const Material& m = scene.materials[a];
    if (!m.is_of_particles()) continue;
    for (std::size_t b = a; b < scene.materials.size(); ++b) {
      const Material& n = scene.materials[b];
      if (!n.is_of_particles() || !m.interacts || !n.interacts) continue;
      smallest.consider_pile(table.pair(a, b).linear, effective_mass(m.mass, n.mass), m.name + " - " + n.name);
    }
    smallest.consider_boundary(table.wall(a).linear, m.mass, m.name + " - wall");
    for (const Collider& collider : scene.colliders) {
      if (!collider.material) continue;
      smallest.consider_boundary(table.pair(a, *collider.material).linear, m.mass,
                                 m.name + " - " + scene.materials[*collider.material].name);
    }
    smallest.consider_drag(m.drag, m);
  }
}

void consider_springs(const Structure& structure, const Scene& scene, const ParticleSet& particles,
                      Smallest& smallest) {
  const SpringSet& springs = structure.springs;
  std::vector<double> stiffness(particles.size(), 0), damping(particles.size(), 0);
  for (std::size_t s = 0; s < springs.size(); ++s) {
    for (const std::uint64_t id : {springs.a[s], springs.b[s]}) {
      const std::size_t i = particles.find(id);
      if (i == particles.size()) continue;
      stiffness[i] += springs.stiffness[s];
      damping[i] += springs.damping[s];
    }
  }
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (std::binary_search(structure.held.begin(), structure.held.end(), particles.id[i])) continue;
    smallest.consider_springs(stiffness[i], damping[i], scene.materials[particles.material[i]], particles.id[i]);
  }
}

}  // namespace

StableStep stable_step(const Scene& scene, const ParticleSet& particles) {
  Smallest smallest;
  consider_contacts(scene, smallest);
  if (scene.structure) consider_springs(*scene.structure, scene, particles, smallest);
  return smallest.step;
}

StableStep stable_step(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  return scene.structure ? stable_step(scene, simulation.particles()) : stable_step(scene);
}

double integration_error(const Measurements& now, const Ledger& ledger, double initial_elastic) {
  const double by_springs = ledger.work[Cause::springs] + ledger.springs.dissipated + ledger.springs.broken_energy;
  return ledger.work[Cause::contact_spring] + by_springs + (now.elastic_energy + now.spring_energy - initial_elastic);
}

double momentum_drift(const Measurements& now, const Ledger& ledger, const Vec3d& initial_momentum) {
  const auto norm = [](const Vec3d& a) { return std::sqrt(dot(a, a)); };
  Vec3d given = ledger.population.born_momentum;
  double scale = now.momentum_scale + norm(initial_momentum) + norm(ledger.removed_momentum) + norm(given);
  for (const Vec3d& impulse : ledger.impulse.of) {
    given += impulse;
    scale += norm(impulse);
  }
  const Vec3d unexplained = now.momentum + ledger.removed_momentum - initial_momentum - given;
  return scale > 0 ? norm(unexplained) / scale : 0;
}

}  // namespace hooke
