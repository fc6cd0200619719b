// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// What a GPU's back end does in ways of its own: held particles before the first list, springs and slots, forces by id
// after ids are numbered anew, displacements that are large, beside the CPU.

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "busy_scenes.h"
#include "hooke/core/springs.h"

namespace hooke::test {
namespace {

// open_scene() with one more material, at the end.
Scene scene_with(const char* name, bool interacts, bool fixed) {
  Scene scene = open_scene();
  Material material = scene.materials[0];
  material.name = name;
  material.interacts = interacts;
  material.fixed = fixed;
  scene.materials.push_back(material);
  return scene;
}

std::vector<NewParticle> ghosts(const Scene& scene, int count, double y) {
  std::vector<NewParticle> added;
  for (int k = 0; k < count; ++k)
    added.push_back({scene.materials.size() - 1, {-90.0 + 2 * (k % 90), y, 90.0 - 2 * (k / 90 % 90)}, {0, 0, 0}});
  return added;
}

// Velocity Verlet moves particles before the first list.
TEST(Gpu, HoldsParticlesFromTheFirstHalfStepOn) {
  Scene scene = scene_with("fixed", true, true);
  scene.integrator = Integrator::velocity_verlet;
  scene.gravity = {0, -10, 0};
  ParticleSet particles = lattice(scene, {5, 5, 5}, {-2, -2, -2}, 1.3, 0.05, 1);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const auto k = static_cast<double>(i % 7);
    particles.material[i] = i % 3 == 0 ? 1 : 0;
    particles.velocity[i] = i % 3 == 0 ? Vec3d{0.5, 0, 0} : Vec3d{k - 3, 0, 2 - k};
  }
  Simulation cpu = simulate(scene, particles, kCpuDouble), gpu = simulate(scene, particles, kGpuDouble);
  for (Simulation* s : {&cpu, &gpu}) {
    ASSERT_TRUE(advance(*s, 10));
    const SimulationState saved = s->state();
    ASSERT_TRUE(advance(*s, 300));
    ASSERT_TRUE(s->restore(saved));
    ASSERT_TRUE(advance(*s, 5));
  }
  expect_same_bits(cpu, gpu);
  Simulation resumed = resume(scene, cpu.state(), kGpuDouble);
  ASSERT_TRUE(advance(resumed, 5));
  ASSERT_TRUE(advance(cpu, 5));
  expect_same_bits(cpu, resumed);
}

// Newborns that touch nothing make no new list, and lie behind the rows of springs.
TEST(Gpu, KeepsItsSpringsWhileParticlesThatTouchNothingAreBorn) {
  Scene scene = scene_with("ghost", false, false);
  ParticleSet particles = lattice(scene, {3, 3, 3}, {-2, -2, -2}, 1.2, 0.01, 1);
  particles.material.assign(particles.size(), 0);
  const auto structure = std::make_shared<Structure>();
  for (std::size_t i = 0; i + 1 < particles.size(); ++i)
    structure->springs.push_back({particles.id[i], particles.id[i + 1], 1.0, 400, 2});
  scene.structure = structure;
  Simulation cpu = simulate(scene, particles, kCpuDouble), gpu = simulate(scene, particles, kGpuDouble);
  for (Simulation* s : {&cpu, &gpu}) {
    ASSERT_TRUE(advance(*s, 3));
    for (const int births : {2, 40, 300, 40}) {
      ASSERT_TRUE(s->add_particles(ghosts(scene, births, 80)));
      ASSERT_TRUE(advance(*s, 5));
    }
  }
  expect_same_bits(cpu, gpu);
}

// So many ids that they are numbered anew.
TEST(Gpu, PushesTheParticlesThatItWasAskedToPush) {
  Scene scene = scene_with("ghost", false, false);
  ParticleSet particles;
  for (int i = 0; i < 10; ++i) add(particles, {3.0 * i - 15, 0, 0}, {0, 0, 0});
  Simulation cpu = simulate(scene, particles, kCpuDouble), gpu = simulate(scene, particles, kGpuDouble);
  for (Simulation* s : {&cpu, &gpu}) {
    ASSERT_TRUE(s->remove_particles(std::vector<std::uint64_t>(particles.id.begin(), particles.id.begin() + 3)));
    const std::uint64_t pushed = particles.id[6];
    const Vec3d force{0, 5, 0};
    ASSERT_TRUE(s->set_external_forces({&pushed, 1}, {&force, 1}));
    for (int round = 0; round < 4; ++round) {
      const auto added = s->add_particles(ghosts(scene, 20000, 90));
      ASSERT_TRUE(added);
      ASSERT_TRUE(s->remove_particles(*added));
      ASSERT_TRUE(advance(*s, 2));
    }
    EXPECT_GT(s->find(pushed)->velocity.y, 0);
  }
  expect_same_bits(cpu, gpu);
}

// Steps in a row end where the host is needed: here particles leave, springs tear, colliders move, new lists are due.
TEST(Gpu, TakesStepsInARowAsOneByOne) {
  Scene scene = busy_scene({Boundary::open, Integrator::symplectic_euler, Precision::double_precision, true});
  const ParticleSet particles = busy_particles(scene);
  const auto structure = std::make_shared<Structure>();
  for (std::size_t i = 0; i + 1 < 400; ++i)
    structure->springs.push_back({particles.id[i], particles.id[i + 1], 0.5, 400, 2, 0.6});
  scene.structure = structure;
  Simulation cpu = simulate(scene, particles, kCpuDouble);
  Simulation one_by_one = simulate(scene, particles, kGpuDouble), in_rows = simulate(scene, particles, kGpuDouble);
  ASSERT_TRUE(advance(cpu, 200));
  for (int k = 0; k < 200; ++k) ASSERT_TRUE(advance(one_by_one, 1));
  for (const int steps : {1, 2, 90, 7, 100}) ASSERT_TRUE(advance(in_rows, steps));
  expect_same_bits(cpu, one_by_one);
  expect_same_bits(cpu, in_rows);
  EXPECT_EQ(cpu.broken_springs(), in_rows.broken_springs());
  EXPECT_GT(cpu.broken_springs().size(), 10U);
  EXPECT_GT(cpu.ledger().removed, 10U);
}

TEST(Gpu, StopsInARowOfStepsWhereTheCpuStops) {
  Scene scene = open_scene();
  scene.domain.boundary[1] = Boundary::spring;
  scene.gravity = {0, -2e4, 0};  // they fall on the floor after some hundred steps, four radii a step
  const ParticleSet particles = lattice(scene, {4, 4, 4}, {-2, -2, -2}, 2.5, 0, 1);
  Simulation cpu = simulate(scene, particles, kCpuDouble), gpu = simulate(scene, particles, kGpuDouble);
  const auto cpu_steps = cpu.step(1000), gpu_steps = gpu.step(1000);
  ASSERT_FALSE(cpu_steps);
  ASSERT_FALSE(gpu_steps);
  EXPECT_EQ(cpu_steps.error().text(), gpu_steps.error().text());
  EXPECT_EQ(cpu.step_count(), gpu.step_count());
  EXPECT_GT(gpu.step_count(), 50);
  EXPECT_EQ(cpu.ledger(), gpu.ledger());
}

// Two particles that fly far together, and meet: their displacements are kept as floats.
TEST(Gpu, MissesNoContactOfParticlesThatHaveComeFar) {
  for (int k = 0; k < 60; ++k) {
    Scene scene = open_scene();
    scene.materials.resize(1);
    scene.gravity = {0, 0, 0};
    scene.domain.min = {-1e5, -1e5, -1e5};
    scene.domain.max = {1e5, 1e5, 1e5};
    ParticleSet particles;
    const double speed = 2e5 + 7.31 * k;
    add(particles, {-9e4, 0.1, 0.2}, {speed, 0, 0});
    add(particles, {-9e4 + 1.2006 + 1e-5 * k, 0.1, 0.2}, {speed - 0.6, 0, 0});
    Simulation cpu = simulate(scene, particles, kCpuDouble), gpu = simulate(scene, particles, kGpuDouble);
    ASSERT_TRUE(advance(cpu, 420));
    ASSERT_TRUE(advance(gpu, 420));
    ASSERT_EQ(cpu.state_hash(), gpu.state_hash()) << k;
  }
}

}  // namespace
}  // namespace hooke::test
