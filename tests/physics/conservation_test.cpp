// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Momentum and energy of many particles: kept where nothing acts from outside, booked where something does.

#include <gtest/gtest.h>

#include <cmath>

#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

constexpr Integrator kIntegrators[] = {Integrator::symplectic_euler, Integrator::velocity_verlet};

double length(const Vec3d& a) { return std::sqrt(dot(a, a)); }

// Rounding of one step is half a unit in the last place a particle at most, and it does not pile up faster than that.
double momentum_limit(const Engine& engine, std::int64_t steps) {
  const double unit = engine.precision == Precision::single_precision ? 0x1p-24 : 0x1p-53;
  return unit * std::sqrt(static_cast<double>(steps)) * 4;
}

TEST(Momentum, IsKeptToRoundingWithoutWallsAndGravity) {
  for (const Boundary boundary : {Boundary::open, Boundary::periodic}) {
    for (const Integrator integrator : kIntegrators) {
      Scene scene = open_scene();
      mix_materials(scene, 0.25);
      scene.integrator = integrator;
      scene.domain.min = {0, 0, 0};
      scene.domain.max = {2.5, 2.5, 2.5};
      if (boundary == Boundary::open) scene.domain = open_scene().domain;
      scene.domain.boundary = {boundary, boundary, boundary};
      for (Material& m : scene.materials) m.drag = 0;
      const ParticleSet particles = lattice(scene, {5, 5, 5}, {0.25, 0.25, 0.25}, 0.5, 0.1, 1);
      for (const Engine& engine : {kReference, kCpuDouble, kCpuSingle}) {
        Simulation simulation = simulate(scene, particles, engine);
        const Vec3d before = measured(simulation).momentum;
        ASSERT_TRUE(advance(simulation, 300));
        const Measurements after = measured(simulation);
        EXPECT_GT(after.momentum_scale, 5) << "they do move";
        EXPECT_LT(length(after.momentum - before) / after.momentum_scale, momentum_limit(engine, 300)) << engine.name();
        EXPECT_LT(momentum_drift(after, simulation.ledger(), simulation.initial_momentum()),
                  momentum_limit(engine, 300));
      }
    }
  }
}

// Gravity, walls, drag and departures: what they give is booked, and nothing is left over.
TEST(Momentum, IsAccountedForWithEverythingThatActs) {
  for (const Integrator integrator : kIntegrators) {
    Scene scene = open_scene();
    mix_materials(scene, 0.25);
    scene.integrator = integrator;
    scene.gravity = {0.5, -9.8, 1};
    scene.domain.min = {0, 0, 0};
    scene.domain.max = {4, 4, 4};
    scene.domain.boundary = {Boundary::open, Boundary::spring, Boundary::periodic};
    const ParticleSet particles = lattice(scene, {6, 6, 6}, {0.7, 0.3, 0.7}, 0.5, 0.1, 2);
    for (const Engine& engine : {kReference, kCpuDouble, kCpuSingle}) {
      Simulation simulation = simulate(scene, particles, engine);
      ASSERT_TRUE(advance(simulation, 600));
      const Measurements after = measured(simulation);
      EXPECT_GT(simulation.ledger().removed, 0U);
      EXPECT_GT(length(simulation.ledger().impulse[Cause::wall]), 1);
      EXPECT_GT(length(simulation.ledger().impulse[Cause::drag]), 0.01);
      EXPECT_LT(momentum_drift(after, simulation.ledger(), simulation.initial_momentum()), momentum_limit(engine, 600))
          << engine.name();
    }
  }
}

TEST(Momentum, DriftNoticesWhatIsMissing) {
  Scene scene = open_scene();
  const ParticleSet particles = pair_on_x(scene, -1, {1, 0, 0}, {0, 0, 0});
  const Simulation simulation = simulate(scene, particles, kReference);
  Measurements wrong = measured(simulation);
  EXPECT_EQ(momentum_drift(wrong, simulation.ledger(), simulation.initial_momentum()), 0);
  wrong.momentum.y += 0.2;
  EXPECT_NEAR(momentum_drift(wrong, simulation.ledger(), simulation.initial_momentum()), 0.1, 1e-15);
}

// A handful of particles that fall on a floor, with dashpots and drag: the largest change of what is accounted for.
double energy_defect(Integrator integrator, double dt, double duration) {
  Scene scene = open_scene();
  mix_materials(scene, 0.25);
  scene.integrator = integrator;
  scene.gravity = {0, -9.8, 0};
  scene.domain.boundary[1] = Boundary::spring;
  scene.domain.min.y = 0;
  scene.time_step = dt;
  ParticleSet particles = lattice(scene, {3, 3, 3}, {0, 0.4, 0}, 0.6, 0.05, 3);
  for (std::size_t i = 0; i < particles.size(); ++i) particles.velocity[i] = {0, -1, 0.1 * double(i % 3)};
  Simulation simulation = simulate(scene, particles, kReference);
  double worst = 0;
  while (simulation.time() < duration) {
    if (!advance(simulation, 1)) break;
    worst = std::max(worst, std::abs(accounted_energy(simulation) - simulation.initial_energy()));
  }
  EXPECT_GT(simulation.ledger().dissipated(), 1);
  EXPECT_GT(std::abs(simulation.ledger().work[Cause::wall]), 1);
  return worst / measured(simulation).momentum_scale;
}

TEST(Energy, IsAccountedForUpToTheIntegratorsOrder) {
  for (const Integrator integrator : kIntegrators) {
    const double coarse = energy_defect(integrator, 4e-4, 0.4);
    const double fine = energy_defect(integrator, 2e-4, 0.4);
    const double finer = energy_defect(integrator, 1e-4, 0.4);
    EXPECT_LT(fine, coarse / 1.6);
    EXPECT_LT(finer, fine / 1.6);
  }
}

TEST(Energy, OfADepartureIsBooked) {
  Scene scene = open_scene();
  scene.gravity = {0, -9.8, 0};
  ParticleSet particles;
  add(particles, {99.995, 0, 0}, {10, 0, 0});
  add(particles, {0, 0, 0}, {1, 0, 0});
  for (const Engine& engine : {kReference, kCpuDouble}) {
    Simulation simulation = simulate(scene, particles, engine);
    ASSERT_TRUE(advance(simulation, 1));
    EXPECT_EQ(simulation.particle_count(), 1U);
    EXPECT_EQ(simulation.ledger().removed, 1U);
    EXPECT_DOUBLE_EQ(simulation.ledger().removed_momentum.x, 10);
    EXPECT_NEAR(simulation.ledger().removed_energy, 50, 1e-3);
    EXPECT_NEAR(accounted_energy(simulation), simulation.initial_energy(), 1e-3);
  }
}

}  // namespace
}  // namespace hooke::test
