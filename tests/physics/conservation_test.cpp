// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Momentum and energy of many particles: kept where nothing acts from outside, in the ledger where something does.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

constexpr Integrator kIntegrators[] = {Integrator::symplectic_euler, Integrator::velocity_verlet};

double length(const Vec3d& a) { return std::sqrt(dot(a, a)); }

// One step rounds by at most half a unit in the last place for each particle, and errors add up no faster than that.
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
      for (const Engine& engine : {kReference, kCpuDouble, kCpuSingle, kGpuDouble, kGpuSingle}) {
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

// Gravity, walls, drag and departures: the ledger accounts for all momentum.
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
    for (const Engine& engine : {kReference, kCpuDouble, kCpuSingle, kGpuDouble, kGpuSingle}) {
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

// A few particles that fall on a floor, with dashpots and drag: the largest change of the accounted energy.
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
  for (const Engine& engine : {kReference, kCpuDouble, kGpuDouble}) {
    Simulation simulation = simulate(scene, particles, engine);
    ASSERT_TRUE(advance(simulation, 1));
    EXPECT_EQ(simulation.particle_count(), 1U);
    EXPECT_EQ(simulation.ledger().removed, 1U);
    EXPECT_DOUBLE_EQ(simulation.ledger().removed_momentum.x, 10);
    EXPECT_NEAR(simulation.ledger().removed_energy, 50, 1e-3);
    EXPECT_NEAR(accounted_energy(simulation), simulation.initial_energy(), 1e-3);
  }
}

// A squeezed block of particles with cohesion; springs tie some of them, and they touch each other from the start.
struct SqueezedBlock {
  explicit SqueezedBlock(Integrator integrator) : particles(lattice(scene, {6, 4, 4}, {-2.6, 0, 0}, 0.9, 0, 1)) {
    scene.integrator = integrator;
    scene.materials[0].surface.cohesion = 5;
    scene.materials[0].surface.range = 0.5;
    auto structure = std::make_shared<Structure>();
    for (std::size_t i = 6; i < particles.size(); i += 3) {
      structure->springs.push_back({particles.id[i - 6], particles.id[i], 0.7, 300, 0.5});
      structure->springs.push_back({particles.id[i - 1], particles.id[i], 1.3, 100, 0});
    }
    scene.structure = structure;
  }

  Scene scene = open_scene();
  ParticleSet particles;
};

// The energy in contacts and springs of particles that sink, or leave through a face in front of the block, in a step
// in which the block hardly moves: each pair counts once, whether one or both of its particles go.
TEST(Energy, OfContactsAndSpringsThatVanishIsBooked) {
  for (const Integrator integrator : kIntegrators) {
    for (const bool sinks : {true, false}) {
      SqueezedBlock block(integrator);
      block.scene.time_step = 1e-6;
      for (Vec3d& v : block.particles.velocity) v = {1, 0, 0};
      if (sinks) {
        block.scene.sinks = {{BoxShape{{-1, -1, -1}, {1, 2.5, 1.3}}}};
      } else {
        block.scene.domain.max.x = 1.9 + 5e-7;
      }
      for (const Engine& engine : {kReference, kCpuDouble, kCpuSingle, kGpuDouble, kGpuSingle}) {
        SCOPED_TRACE(engine.name());
        Simulation simulation = simulate(block.scene, block.particles, engine);
        const Measurements before = measured(simulation);
        ASSERT_TRUE(advance(simulation, 1));
        const Measurements after = measured(simulation);
        EXPECT_EQ(simulation.particle_count(), block.particles.size() - (sinks ? 12 : 16));
        const double pinned = before.elastic_energy + before.spring_energy;
        EXPECT_LT(after.springs, before.springs);
        const double rounding = engine.precision == Precision::single_precision ? 1e-5 : 1e-6;
        EXPECT_NEAR(simulation.ledger().removed_elastic, pinned - after.elastic_energy - after.spring_energy,
                    rounding * pinned);
        EXPECT_NEAR(accounted_energy(simulation), simulation.initial_energy(), rounding * pinned);
      }
    }
  }
}

// A block flies apart while a sink eats into it: the energy missing from the ledger is the integrator's error. It falls
// with the step, and is small compared with the energy that went with sunk particles.
TEST(Energy, OfWhatVanishesInMotionIsBookedUpToTheIntegratorsOrder) {
  const auto defect = [](Integrator integrator, double dt) {
    SqueezedBlock block(integrator);
    block.scene.time_step = dt;
    block.scene.sinks = {{BoxShape{{0, -9, -9}, {9, 9, 1.3}}}};
    for (std::size_t i = 0; i < block.particles.size(); ++i) block.particles.velocity[i] = {1, 0, -1};
    Simulation simulation = simulate(block.scene, block.particles, kCpuDouble);
    EXPECT_TRUE(advance(simulation, static_cast<std::int64_t>(std::lround(0.2 / dt))));
    EXPECT_GT(simulation.ledger().population.sunk, 20U);
    EXPECT_LT(simulation.ledger().population.sunk, 90U);
    const double left = integration_error(measured(simulation), simulation.ledger(), simulation.initial_elastic());
    return std::abs(left) / simulation.ledger().removed_elastic;
  };
  for (const Integrator integrator : kIntegrators) {
    const double coarse = defect(integrator, 4e-4), fine = defect(integrator, 1e-4);
    EXPECT_LT(fine, coarse / 2.5);
    EXPECT_LT(fine, 0.01);
    EXPECT_GT(fine, 0);
  }
}

}  // namespace
}  // namespace hooke::test
