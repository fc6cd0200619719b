// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Particles that attract each other: known orbits, and balances of energy and momentum.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clusters.h"
#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

// A scene without other forces than the particles' attraction of each other.
Scene attracting_scene(double constant, Integrator integrator = Integrator::velocity_verlet) {
  Scene scene = open_scene();
  scene.materials = {{"star", 0.01, 1, {0, 0, 0}, 0, ""}, {"planet", 0.01, 1e-3, {0, 0, 0}, 0, ""}};
  scene.integrator = integrator;
  scene.attraction.emplace();
  scene.attraction->constant = constant;
  return scene;
}

class Orbits : public testing::TestWithParam<Engine> {};

// Two masses on an ellipse of eccentricity 0.2 come back to where they were after each period 2 pi sqrt(a^3 / (G M)).
// Velocity Verlet's period has a relative error of (omega dt)^2 / 24 times a factor for the ellipse, some 1e-7.
TEST_P(Orbits, OfKeplerClose) {
  constexpr int kSteps = 6000, kTurns = 10;
  constexpr double kMajor = 1, kEccentricity = 0.2, kConstant = 2;
  Scene scene = attracting_scene(kConstant);
  const double m_1 = scene.materials[0].mass, m_2 = scene.materials[1].mass, total = m_1 + m_2;
  const double period = 2 * std::numbers::pi * std::sqrt(kMajor * kMajor * kMajor / (kConstant * total));
  scene.time_step = period / kSteps;
  const double distance = kMajor * (1 + kEccentricity);  // at their largest distance, where they are slowest
  const double speed = std::sqrt(kConstant * total / kMajor * (1 - kEccentricity) / (1 + kEccentricity));
  ParticleSet particles;
  add(particles, {-distance * m_2 / total, 0, 0}, {0, -speed * m_2 / total, 0}, 0);
  add(particles, {distance * m_1 / total, 0, 0}, {0, speed * m_1 / total, 0}, 1);
  Simulation s = simulate(scene, particles, GetParam());
  const double energy = s.initial_energy();
  EXPECT_NEAR(energy, -kConstant * m_1 * m_2 / (2 * kMajor), 1e-12 * m_2);

  for (int turn = 0; turn < kTurns; ++turn) {
    ASSERT_TRUE(advance(s, kSteps));
    EXPECT_NEAR(accounted_energy(s) / energy, 1, 1e-6) << "after turn " << turn;
  }
  // The error of the period over all turns shows in the phase of the two masses along their orbit.
  const Vec3d apart = s.positions()[1] - s.positions()[0];
  EXPECT_NEAR(apart.x, distance, 1e-6 * distance);
  EXPECT_LT(std::abs(apart.y) / (speed * period) / kTurns, 1e-6);
  EXPECT_EQ(apart.z, 0);
}

// Three equal masses chase each other along a figure eight (Chenciner and Montgomery 2000; initial values by Simo):
// after a period each mass is back.
TEST_P(Orbits, OfThreeBodiesAreAFigureEight) {
  constexpr double kPeriod = 6.32591398;
  constexpr int kSteps = 6000;
  Scene scene = attracting_scene(1);
  scene.time_step = kPeriod / kSteps;
  const Vec3d x{0.97000436, -0.24308753, 0}, v{-0.93240737, -0.86473146, 0};
  ParticleSet particles;
  add(particles, x, -0.5 * v);
  add(particles, -x, -0.5 * v);
  add(particles, {0, 0, 0}, v);
  Simulation s = simulate(scene, particles, GetParam());
  ASSERT_TRUE(advance(s, kSteps / 3));
  // After a third of a period each mass is about where another mass was: 2/3 of a step is missing.
  for (const Vec3d& now : s.positions()) {
    double nearest = 1;
    for (const Vec3d& before : particles.position) {
      const Vec3d off = now - before;
      nearest = std::min(nearest, std::sqrt(dot(off, off)));
    }
    EXPECT_LT(nearest, 2 * scene.time_step);
  }
  ASSERT_TRUE(advance(s, kSteps - kSteps / 3));
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d off = s.positions()[i] - particles.position[i];
    // Initial values have eight digits, and the integrator's error is (omega dt)^2.
    EXPECT_LT(std::sqrt(dot(off, off)), 1e-5) << i;
  }
  EXPECT_NEAR(accounted_energy(s) / s.initial_energy(), 1, 1e-7);
}

INSTANTIATE_TEST_SUITE_P(Engines, Orbits, testing::Values(kReference, kCpuDouble, kGpuDouble),
                         [](const auto& test) { return test.param.name(); });

// A cluster at rest collapses: the work of attraction equals the kinetic energy, up to rounding, under either
// integrator. The work differs from the loss of potential energy by the integrator's error.
class ClusterBooks : public testing::TestWithParam<std::tuple<Integrator, Attraction::Method>> {};

TEST_P(ClusterBooks, Close) {
  const auto [integrator, method] = GetParam();
  Scene scene = attracting_scene(1, integrator);
  scene.attraction->softening = 0.1;
  scene.attraction->method = method;
  scene.attraction->accuracy = 1e-3;
  scene.time_step = 2e-4;
  ParticleSet particles;
  for (const Vec3d& x : bench::plummer_sphere(300, 1, 5, 8)) add(particles, x, {0, 0, 0});
  Simulation s = simulate(scene, particles, kCpuDouble);
  const double potential = measured(s).attraction_energy;
  EXPECT_LT(potential, 0);
  EXPECT_EQ(s.initial_energy(), potential);
  ASSERT_TRUE(advance(s, 300));
  const Measurements now = measured(s);
  ASSERT_GT(now.kinetic_energy, 0.001 * std::abs(potential));
  EXPECT_NEAR(s.ledger().work[Cause::attraction] / now.kinetic_energy, 1, 1e-10);
  // Symplectic Euler's mean velocity of a step is off by half a kick; the tree's potential is as accurate as its
  // forces.
  const double integration = s.ledger().work[Cause::attraction] + now.attraction_energy - potential;
  const bool exact = method == Attraction::Method::direct && integrator == Integrator::velocity_verlet;
  EXPECT_LT(std::abs(integration) / now.kinetic_energy, exact ? 1e-4 : 2e-2);
  // Pair by pair the total momentum is 0 up to rounding; the tree's errors do not cancel.
  const Vec3d given = s.ledger().impulse[Cause::attraction];
  EXPECT_LT(std::sqrt(dot(given, given)), (method == Attraction::Method::direct ? 1e-12 : 1e-3) * now.momentum_scale);
  const Vec3d off = now.momentum - given;
  EXPECT_LT(std::sqrt(dot(off, off)), 1e-12 * now.momentum_scale);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ClusterBooks,
                         testing::Combine(testing::Values(Integrator::symplectic_euler, Integrator::velocity_verlet),
                                          testing::Values(Attraction::Method::direct, Attraction::Method::tree)));

}  // namespace
}  // namespace hooke::test
