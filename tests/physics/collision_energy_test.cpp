// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Energy before and after single impacts, from head-on to grazing. For years another engine had a separate wall law
// that gained energy at grazing impact; Hooke's walls are partners of infinite mass in its only law.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

constexpr double kRadius = 0.5;
constexpr double kStiffness = 1000;
constexpr double kSpeed = 1;  // relative, m/s: overlaps of a fiftieth of a diameter
constexpr double kApart = 4;  // distance between two experiments, m

struct Impact {
  double angle;  // degrees from head-on; 90 passes by
  double phase;  // 0 to 1: moment of the touch within a step
};

// The cosine of the angle of impact: the part of `speed` along the normal, 0 at 90 degrees.
double cosine(const Impact& impact) { return std::cos(impact.angle * M_PI / 180); }

struct Law {
  double omega_dt;
  double damping_ratio;
  double shear_ratio;  // like the damping ratio, for c_s
  Integrator integrator;
  double mass_2 = 1;
};

Scene impact_scene(const Law& law, double m_eff) {
  Scene scene = open_scene();
  const double c = 2 * std::sqrt(kStiffness * m_eff);
  scene.domain.min = {-1000, -1000, -1000};
  scene.domain.max = {1000, 1000, 1000};
  scene.time_step = law.omega_dt / std::sqrt(kStiffness / m_eff);
  scene.integrator = law.integrator;
  const ContactCoefficients<double> contact{kStiffness, law.shear_ratio * c, law.damping_ratio * c};
  scene.materials = {{"a", kRadius, 1, contact, 0, ""}, {"b", kRadius, law.mass_2, contact, 0, ""}};
  return scene;
}

Vec3d place(std::size_t i, std::size_t count) {
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  const auto at = [&](std::size_t k) { return kApart * (static_cast<double>(k) - static_cast<double>(side) / 2); };
  return {at(i % side), 0, at(i / side)};
}

// Steps until every contact is over, except contacts damped so much that they never end.
bool finish(Simulation& simulation, const Law& law) {
  return advance(simulation, static_cast<std::int64_t>(12 / law.omega_dt));
}

// The remaining energy of the relative motion, `w` (m/s), and of the spring.
double energy_left(const Vec3d& w, double overlap, double m_eff) {
  const double spring = overlap > 0 ? kStiffness / m_eff * overlap * overlap : 0;
  return (dot(w, w) + spring) / (kSpeed * kSpeed);
}

// For each impact, the energy of the relative motion after it over the energy before. All happen side by side.
std::vector<double> pair_impacts(const Law& law, const std::vector<Impact>& impacts) {
  const double m_eff = law.mass_2 / (1 + law.mass_2);
  const Scene scene = impact_scene(law, m_eff);
  ParticleSet particles;
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    const double sine = std::sin(impacts[i].angle * M_PI / 180);
    const Vec3d x = place(i, impacts.size());
    const double gap = 2 * kRadius * cosine(impacts[i]) + impacts[i].phase * kSpeed * scene.time_step;
    add(particles, x, {0, kSpeed, 0}, 0);
    add(particles, x + Vec3d{2 * kRadius * sine, gap, 0}, {0, 0, 0}, 1);
  }
  Simulation simulation = simulate(scene, particles, kCpuDouble);
  std::vector<double> left;
  if (!finish(simulation, law)) return left;
  const auto x = simulation.positions(), v = simulation.velocities();
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    const Vec3d apart = x[2 * i] - x[2 * i + 1];
    left.push_back(energy_left(v[2 * i] - v[2 * i + 1], 2 * kRadius - std::sqrt(dot(apart, apart)), m_eff));
  }
  return left;
}

std::vector<double> wall_impacts(const Law& law, const std::vector<Impact>& impacts) {
  Scene scene = impact_scene(law, 1);
  scene.domain.boundary[1] = Boundary::spring;
  scene.domain.min.y = -kRadius;
  ParticleSet particles;
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    const double sine = std::sin(impacts[i].angle * M_PI / 180);
    const double gap = impacts[i].phase * kSpeed * cosine(impacts[i]) * scene.time_step;
    // All slide the same way, so that experiments do not meet.
    add(particles, place(i, impacts.size()) + Vec3d{0, gap, 0}, {kSpeed * sine, -kSpeed * cosine(impacts[i]), 0}, 0);
  }
  Simulation simulation = simulate(scene, particles, kCpuDouble);
  std::vector<double> left;
  if (!finish(simulation, law)) return left;
  EXPECT_EQ(measured(simulation).contacts, 0U);
  const auto x = simulation.positions(), v = simulation.velocities();
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    left.push_back(energy_left(v[i], kRadius - (x[i].y - scene.domain.min.y), 1));
  }
  return left;
}

std::vector<Impact> all_impacts(int last_degree, int phases) {
  std::vector<Impact> impacts;
  for (int degree = 0; degree <= last_degree; ++degree) {
    for (int phase = 0; phase < phases; ++phase) impacts.push_back({double(degree), (phase + 0.5) / phases});
  }
  return impacts;
}

class Impacts : public testing::TestWithParam<Integrator> {};

// DESIGN section 8: never rises where omega0 dt <= 0.15 and the damping ratio is 0.05 or more.
TEST_P(Impacts, NeverGainEnergy) {
  const std::vector<Impact> impacts = all_impacts(89, 8);
  for (const double omega_dt : {0.02, 0.08, 0.15}) {
    for (const double damping : {0.05, 0.3, 1.2}) {
      for (const double shear : {0.0, 0.05, 0.5}) {
        for (const double mass_2 : {1.0, 20.0}) {
          const Law law{omega_dt, damping, shear, GetParam(), mass_2};
          const auto check = [&](const std::vector<double>& left, const char* partner) {
            ASSERT_EQ(left.size(), impacts.size());
            for (std::size_t i = 0; i < left.size(); ++i) {
              EXPECT_LE(left[i], 1 + 1e-12)
                  << partner << " at " << impacts[i].angle << " degrees, phase " << impacts[i].phase << ", omega0 dt "
                  << omega_dt << ", damping ratio " << damping << ", shear " << shear;
            }
          };
          check(pair_impacts(law, impacts), "pair");
          if (mass_2 == 1.0) check(wall_impacts(law, impacts), "wall");
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, Impacts,
                         testing::Values(Integrator::symplectic_euler, Integrator::velocity_verlet),
                         [](const auto& instance) {
                           return instance.param == Integrator::velocity_verlet ? "velocity_verlet"
                                                                                : "symplectic_euler";
                         });

// DESIGN section 8: undamped, energy changes by at most (omega0 dt)^2/4 for any phase of entry, symplectic Euler.
TEST(UndampedImpacts, GainAndLoseAtMostTheirBoundAtAnyPhase) {
  for (const double omega_dt : {0.05, 0.15, 0.3, 0.55}) {
    const double bound = omega_dt * omega_dt / 4;
    const Law law{omega_dt, 0, 0, Integrator::symplectic_euler};
    for (const bool wall : {false, true}) {
      const std::vector<Impact> head_on = all_impacts(0, 400);
      const auto left = wall ? wall_impacts(law, head_on) : pair_impacts(law, head_on);
      ASSERT_EQ(left.size(), head_on.size());
      for (std::size_t i = 0; i < left.size(); ++i) {
        EXPECT_LE(std::abs(left[i] - 1), bound)
            << (wall ? "wall" : "pair") << ", omega0 dt " << omega_dt << ", phase " << head_on[i].phase;
      }
    }
  }
}

TEST(UndampedImpacts, GainAtMostTheirBoundAtAnyAngle) {
  const std::vector<Impact> impacts = all_impacts(89, 20);
  for (const double omega_dt : {0.15, 0.55}) {
    const Law law{omega_dt, 0, 0, Integrator::symplectic_euler};
    for (const bool wall : {false, true}) {
      const auto left = wall ? wall_impacts(law, impacts) : pair_impacts(law, impacts);
      ASSERT_EQ(left.size(), impacts.size());
      for (std::size_t i = 0; i < left.size(); ++i) {
        EXPECT_LE(left[i] - 1, omega_dt * omega_dt / 4)
            << (wall ? "wall" : "pair") << " at " << impacts[i].angle << " degrees, phase " << impacts[i].phase;
      }
    }
  }
}

}  // namespace
}  // namespace hooke::test
