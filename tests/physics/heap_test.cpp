// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <cmath>

#include "hooke/core/contacts.h"
#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

// The settled heap presses on the floor with its weight, and equally on opposite walls.
TEST(Heap, WeighsOnTheFloorWhatItsParticlesWeigh) {
  for (const Engine& engine : {kCpuDouble, kCpuSingle, kGpuDouble, kGpuSingle}) {
    for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
      Scene scene = open_scene();
      mix_materials(scene, 0.25);
      for (Material& m : scene.materials) m.contact.damping = m.contact.shear = 20;
      scene.contacts.clear();
      scene.time_step = 0.002;
      scene.integrator = integrator;
      scene.gravity = {0, -9.8, 0};
      scene.domain.min = {-10, -20, 5};
      scene.domain.max = {-7, 0, 8};
      scene.domain.boundary = {Boundary::spring, Boundary::spring, Boundary::spring};
      Simulation simulation = simulate(scene, lattice(scene, {5, 10, 5}, {-9.7, -19.6, 5.3}, 0.6, 0.05, 4), engine);
      double weight = 0;
      for (const std::uint16_t m : simulation.particles().material) weight += 9.8 * scene.materials[m].mass;

      ASSERT_TRUE(advance(simulation, 6000));
      const Vec3d before = simulation.ledger().impulse[Cause::wall];
      const std::int64_t steps = 2000;
      ASSERT_TRUE(advance(simulation, steps));
      const double duration = static_cast<double>(steps) * scene.time_step;
      const Vec3d mean = (1 / duration) * (simulation.ledger().impulse[Cause::wall] - before);
      const Measurements now = measured(simulation);
      EXPECT_LT(now.momentum_scale * 9.8 / weight, 0.01) << "settled: the mean speed, m/s";
      EXPECT_NEAR(mean.y / weight, 1, 1e-3) << engine.name();
      EXPECT_NEAR(now.wall_force.y / weight, 1, 1e-2) << "the floor pushes up";
      EXPECT_NEAR(mean.x / weight, 0, 1e-3) << "left and right walls balance";
      EXPECT_NEAR(mean.z / weight, 0, 1e-3);
    }
  }
}

// The same for a floor that is a collider, from the listed contacts of a snapshot.
TEST(Heap, WeighsOnACollider) {
  Scene scene = open_scene();
  mix_materials(scene, 0.25);
  for (Material& m : scene.materials) {
    m.contact.damping = m.contact.shear = 20;
    m.surface.friction = 0.3;
  }
  scene.contacts.clear();
  scene.time_step = 0.002;
  scene.gravity = {0, -9.8, 0};
  Collider tray;
  tray.name = "tray";
  tray.shape = BoxShape{{-3, -4, -3}, {3, 4, 3}};
  tray.hollow = true;
  scene.colliders = {tray};
  Simulation simulation = simulate(scene, lattice(scene, {5, 5, 5}, {-1.4, -3.5, -1.4}, 0.7, 0.05, 4), kCpuDouble);
  double weight = 0;
  for (const std::uint16_t m : simulation.particles().material) weight += 9.8 * scene.materials[m].mass;
  ASSERT_TRUE(advance(simulation, 20000));
  ASSERT_LT(measured(simulation).momentum_scale * 9.8 / weight, 0.01) << "settled: the mean speed, m/s";
  Vec3d sum{0, 0, 0};
  for (const Contact& contact : find_contacts(scene, simulation.particles(), {simulation.time(), {}})) {
    if (contact.b == Contact::kCollider) sum += contact.force;
  }
  EXPECT_NEAR(sum.y / weight, 1, 1e-2) << "what still creeps presses a little more or less";
  EXPECT_NEAR(sum.x / weight, 0, 1e-2);
  EXPECT_NEAR(sum.z / weight, 0, 1e-2);
}

// A column of n particles: contact j carries the weight of the n - j particles above it.
TEST(Column, IsCompressedByTheWeightAbove) {
  Scene scene = open_scene();
  scene.gravity = {0, -9.8, 0};
  scene.domain.boundary[1] = Boundary::spring;
  scene.domain.min.y = 0;
  scene.materials[0].contact.damping = 20;
  const int count = 8;
  ParticleSet particles;
  double y = 0.5;
  for (int i = 0; i < count; ++i) {
    y -= (i == 0 ? count : 0) * 9.8 / 1000;
    if (i > 0) y += 1 - (count - i) * 9.8 / 1000;
    add(particles, {0, y, 0}, {0, 0, 0});
  }
  Simulation simulation = simulate(scene, particles, kReference);
  ASSERT_TRUE(advance(simulation, 2000));
  for (std::size_t i = 0; i < particles.size(); ++i) {
    EXPECT_NEAR(simulation.positions()[i].y, particles.position[i].y, 1e-12);
  }
  EXPECT_NEAR(measured(simulation).wall_force.y, count * 9.8, 1e-9);
  EXPECT_NEAR(measured(simulation).max_pair_overlap_ratio, (count - 1) * 9.8 / 1000, 1e-12);
}

}  // namespace
}  // namespace hooke::test
