// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The difference between the work of contacts and springs and the change of their energy.

#include <gtest/gtest.h>

#include <cmath>

#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

class Integration : public testing::TestWithParam<Integrator> {
 protected:
  // A hundred particles that bump into each other for a second, half of them tied. The error relative to the sum of all
  // causes' work.
  static double error(double dt) {
    Scene scene = open_scene();
    scene.integrator = GetParam();
    scene.time_step = dt;
    const ParticleSet particles = cloud(scene, 100, {0, 0, 0}, {5, 5, 5}, 3, 8);
    auto structure = std::make_shared<Structure>();
    for (std::size_t i = 3; i < particles.size(); i += 4) {
      const Vec3d d = particles.position[i] - particles.position[i - 1];
      Spring s{particles.id[i - 1], particles.id[i], 0.9 * std::sqrt(dot(d, d)), 1000, 2};
      if (i % 3 == 0) s.break_strain = 0.15;
      structure->springs.push_back(s);
    }
    scene.structure = structure;
    Simulation s = simulate(scene, particles, kCpuDouble);
    EXPECT_TRUE(advance(s, std::lround(1 / dt)));
    const Measurements now = measured(s);
    EXPECT_GT(s.ledger().springs.broken, 0U);
    const double error = integration_error(now, s.ledger(), s.initial_elastic());
    // No other cause acts: the balance of energy has the same error.
    EXPECT_NEAR(accounted_energy(s) - s.initial_energy(), error, 1e-9 * s.initial_energy());
    double throughput = s.initial_energy();
    for (const double work : s.ledger().work.of) throughput += std::abs(work);
    return error / throughput;
  }
};

// omega0 = sqrt(k / m_eff) = 44.7 /s.
TEST_P(Integration, IsAThousandthOfTheThroughputAndFallsWithTheStep) {
  const double omega0 = std::sqrt(1000 / 0.5);
  const double coarse = std::abs(error(0.2 / omega0)), fine = std::abs(error(0.05 / omega0));
  const double finest = std::abs(error(0.0125 / omega0));
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, 0.5 * coarse);
  EXPECT_LT(finest, 0.5 * fine);
  EXPECT_GT(coarse, 1e-6) << "there is something to fall";
}

INSTANTIATE_TEST_SUITE_P(Integrators, Integration,
                         testing::Values(Integrator::symplectic_euler, Integrator::velocity_verlet),
                         [](const auto& test) {
                           return test.param == Integrator::velocity_verlet ? "VelocityVerlet" : "SymplecticEuler";
                         });

}  // namespace
}  // namespace hooke::test
