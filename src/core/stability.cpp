// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/physics/stability.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "hooke/base/format.h"
#include "hooke/base/printable.h"
#include "hooke/core/simulation.h"

namespace hooke {
namespace {

// Of two coefficients that limit a step together, the one that alone would limit it to about the same; or both.
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
    step.limit = formatted(
        "{} of {}", limiting(omega2, gamma, "stiffness", "shear and damping", "stiffness, shear and damping"), pair);
  }
  // A wall is one partner that does not move, where a pile has a dozen that do.
  void consider_boundary(const ContactCoefficients<double>& c, double mass, const std::string& pair) {
    if (is_smaller(c.stiffness / mass, (c.shear + c.damping) / mass)) step.limit = "stiffness and damping of " + pair;
  }
  // All that brakes particles of a mass: `rate` in kg/s.
  void consider_drag(double rate, double mass, const std::string& what) {
    if (is_smaller(0, rate / mass)) step.limit = what;
  }
  // The springs that tie one particle, with the sums K and C. No mode of particles and springs is faster than
  // omega^2 = 2 K/m, gamma = 2 C/m of the particle with the most: (u_i - u_p)^2 <= 2 (u_i^2 + u_p^2) for each spring.
  // Returns whether these springs limit the step so far.
  bool consider_springs(double stiffness, double damping, double mass, std::uint64_t id) {
    const double omega2 = 2 * stiffness / mass, gamma = 2 * damping / mass;
    if (!is_smaller(omega2, gamma)) return false;
    step.limit = formatted("{} of the springs around particle {}",
                           limiting(omega2, gamma, "stiffness", "damping", "stiffness and damping"), id);
    return true;
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
  std::vector<std::string> names;
  for (const Material& m : scene.materials) names.push_back(printable(m.name));
  for (std::size_t a = 0; a < scene.materials.size(); ++a) {
    const Material& m = scene.materials[a];
    if (!m.is_of_particles()) continue;
    for (std::size_t b = a; b < scene.materials.size(); ++b) {
      const Material& n = scene.materials[b];
      if (!n.is_of_particles() || !m.interacts || !n.interacts) continue;
      smallest.consider_pile(table.pair(a, b).linear, effective_mass(m.mass, n.mass), names[a] + " - " + names[b]);
    }
    smallest.consider_boundary(table.wall(a).linear, m.mass, names[a] + " - wall");
    for (const Collider& collider : scene.colliders) {
      if (!collider.material) continue;
      smallest.consider_boundary(table.pair(a, *collider.material).linear, m.mass,
                                 names[a] + " - " + names[*collider.material]);
    }
  }
}

// The most that a field brakes particles of this material, kg/s, at any position.
double braking(const Field& field, const Material& m, std::size_t material) {
  const std::vector<std::size_t>& felt_by = field.materials;
  if (!felt_by.empty() && std::find(felt_by.begin(), felt_by.end(), material) == felt_by.end()) return 0;
  if (const auto* wind = std::get_if<Wind>(&field.law)) return wind->drag.value_or(0);  // the material's own is counted
  const auto* push = std::get_if<PushToward>(&field.law);
  return push != nullptr && push->time > 0 ? m.mass / push->time : 0;
}

// Drag and fields brake a particle together; those with a good part in it are named.
void consider_braking(const Scene& scene, Smallest& smallest) {
  constexpr double kGoodPart = 0.1;
  for (std::size_t a = 0; a < scene.materials.size(); ++a) {
    const Material& m = scene.materials[a];
    if (!m.is_of_particles()) continue;
    std::vector<std::pair<double, std::string>> parts{{m.drag, "drag"}};
    double all = m.drag;
    for (std::size_t f = 0; f < scene.fields.size(); ++f) {
      const double rate = braking(scene.fields[f], m, a);
      const char* law = std::holds_alternative<Wind>(scene.fields[f].law) ? "drag of the wind" : "time of the push";
      parts.emplace_back(rate, formatted("{} fields[{}]", law, f));
      all += rate;
    }
    std::string named;
    for (const auto& [rate, name] : parts) {
      if (rate > kGoodPart * all) named += (named.empty() ? "" : " and ") + name;
    }
    smallest.consider_drag(all, m.mass, named + (named == "drag" ? " of " : " on ") + printable(m.name));
  }
}

// The groups of springs that end at a particle, and its material: "bodies[0] and springs[1], jelly".
std::string springs_around(const Structure& structure, std::uint64_t id, const Material& m) {
  const SpringSet& springs = structure.springs;
  std::string names;
  std::size_t s = 0;
  for (const SpringGroup& group : structure.groups) {
    bool ends_here = false;
    for (; s < group.end; ++s) ends_here = ends_here || springs.a[s] == id || springs.b[s] == id;
    if (ends_here) names += (names.empty() ? "" : " and ") + group.name;
  }
  return names + (names.empty() ? "" : ", ") + printable(m.name);
}

// Wind on a triangle brakes each corner along the normal, by a third of k_A A (docs/theory.md eq. 15): no mode of a
// sheet is braked faster than the corner that is braked most.
void consider_sheets(const Structure& structure, const Scene& scene, const ParticleSet& particles, Smallest& smallest) {
  for (std::size_t f = 0; f < scene.fields.size(); ++f) {
    const auto* wind = std::get_if<Wind>(&scene.fields[f].law);
    if (wind == nullptr || !(wind->area_drag > 0)) continue;
    for (std::size_t k = 0; k < structure.surfaces.size(); ++k) {
      const Surface& surface = structure.surfaces[k];
      std::vector<double> area(surface.particles.size(), 0);
      for (std::size_t t = 0; t + 2 < surface.triangles.size(); t += 3) {
        std::array<std::size_t, 3> at{};
        for (std::size_t c = 0; c < 3; ++c) at[c] = particles.find(surface.particles[surface.triangles[t + c]]);
        if (std::find(at.begin(), at.end(), particles.size()) != at.end()) continue;
        const auto edge = [&](std::size_t c) {
          return nearest_displacement(particles.position[at[c]], particles.position[at[0]], scene.domain.period());
        };
        const Vec3d twice = cross(edge(1), edge(2));
        for (std::size_t c = 0; c < 3; ++c) area[surface.triangles[t + c]] += std::sqrt(dot(twice, twice)) / 6;
      }
      for (std::size_t c = 0; c < area.size(); ++c) {
        const std::size_t i = particles.find(surface.particles[c]);
        if (i == particles.size()) continue;
        smallest.consider_drag(wind->area_drag * area[c], scene.materials[particles.material[i]].mass,
                               formatted("area_drag of the wind fields[{}] on cloths[{}]", f, k));
      }
    }
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
  std::size_t worst = particles.size();
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const std::uint64_t id = particles.id[i];
    if (std::binary_search(structure.pinned.begin(), structure.pinned.end(), id)) continue;
    const double mass = scene.materials[particles.material[i]].mass;
    if (smallest.consider_springs(stiffness[i], damping[i], mass, id)) worst = i;
  }
  if (worst == particles.size()) return;
  const Material& m = scene.materials[particles.material[worst]];
  smallest.step.limit += formatted(" ({})", springs_around(structure, particles.id[worst], m));
}

}  // namespace

StableStep stable_step(const Scene& scene, const ParticleSet& particles) {
  Smallest smallest;
  consider_contacts(scene, smallest);
  consider_braking(scene, smallest);
  if (scene.structure) {
    consider_springs(*scene.structure, scene, particles, smallest);
    consider_sheets(*scene.structure, scene, particles, smallest);
  }
  return smallest.step;
}

std::string unstable_step(const Scene& scene, const StableStep& stable) {
  if (scene.time_step <= stable.seconds) return {};
  return formatted("{:.6g} s is {:.3g} times the stable step {:.6g} s, which the {} sets", scene.time_step,
                   scene.time_step / stable.seconds, stable.seconds, stable.limit);
}

StableStep stable_step(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  return scene.structure ? stable_step(scene, simulation.particles()) : stable_step(scene);
}

double integration_error(const Measurements& now, const Ledger& ledger, double initial_elastic) {
  const double by_springs = ledger.work[Cause::springs] + ledger.springs.dissipated + ledger.springs.broken_energy;
  const double gained = now.elastic_energy + now.spring_energy + ledger.removed_elastic - initial_elastic;
  return ledger.work[Cause::contact_spring] + by_springs + gained;
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
