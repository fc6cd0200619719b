// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/cpu_backend.h"

#include <gtest/gtest.h>

#include <thread>

#include "hooke/backends/cpu/isa.h"
#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

TEST(CpuBackend, RefusesWhatIsNotToBeHad) {
  const auto isa = make_cpu_backend({Precision::single_precision, 1, "avx9"});
  ASSERT_FALSE(isa);
  EXPECT_EQ(isa.error().kind, Error::Kind::bad_input);
  EXPECT_NE(isa.error().text().find("\"avx9\""), std::string::npos);
  EXPECT_NE(isa.error().text().find("portable"), std::string::npos) << "and says what there is";
  for (const int threads : {-1, 1025}) {
    const auto backend = make_cpu_backend({Precision::single_precision, threads, ""});
    ASSERT_FALSE(backend);
    EXPECT_EQ(backend.error().kind, Error::Kind::bad_input);
  }
}

TEST(CpuBackend, TakesAsManyThreadsAsTheMachineHas) {
  const auto backend = make_cpu_backend();
  ASSERT_TRUE(backend);
  EXPECT_EQ((*backend)->info().threads, static_cast<int>(std::thread::hardware_concurrency()));
  EXPECT_EQ((*backend)->info().isa, available_isas().front().name);
}

TEST(CpuBackend, AlwaysHasThePortableAndTheScalarInstructionSet) {
  EXPECT_STREQ(available_isas().back().name, "scalar");
  EXPECT_TRUE(choose_isa("portable"));
  EXPECT_TRUE(choose_isa("scalar"));
}

TEST(CpuBackend, KeepsItsListWhileNothingMoves) {
  Scene scene = open_scene();
  const ParticleSet particles = lattice(scene, {10, 10, 10}, {0, 0, 0}, 1.01, 0, 1);
  Simulation simulation = simulate(scene, particles, kCpuSingle);
  const auto before = simulation.neighbour_statistics().rebuilds;
  ASSERT_TRUE(advance(simulation, 100));
  EXPECT_EQ(simulation.neighbour_statistics().rebuilds, before);
  EXPECT_GE(simulation.neighbour_statistics().slots_per_particle, 5);
}

// Balls 1.2 diameters apart are within the first skin of each other. Once a list has lasted long, a thinner skin is
// used.
TEST(CpuBackend, ThinsOutAListThatLasts) {
  Scene scene = open_scene();
  const ParticleSet particles = lattice(scene, {10, 10, 10}, {0, 0, 0}, 1.2, 0, 1);
  Simulation simulation = simulate(scene, particles, kCpuSingle);
  ASSERT_TRUE(advance(simulation, 100));
  EXPECT_GE(simulation.neighbour_statistics().slots_per_particle, 5);
  ASSERT_TRUE(advance(simulation, 100));
  EXPECT_EQ(simulation.neighbour_statistics().rebuilds, 2U);
  EXPECT_EQ(simulation.neighbour_statistics().slots_per_particle, 0);
}

TEST(CpuBackend, ForgetsDepartedParticles) {
  Scene scene = open_scene();
  scene.domain.min = {-1, -1, -1};
  scene.domain.max = {1, 1, 1};
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
    scene.integrator = integrator;
    ParticleSet particles;
    for (int i = 0; i < 20; ++i) add(particles, {0, 0, -0.9 + 0.09 * i}, {i % 2 == 0 ? 100.0 : 0, 0, 0});
    for (Material& m : scene.materials) m.radius = 0.01;
    Simulation simulation = simulate(scene, particles, kCpuSingle);
    ASSERT_TRUE(advance(simulation, 20));
    EXPECT_EQ(simulation.particle_count(), 10U);
    EXPECT_EQ(simulation.ledger().removed, 10U);
    for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(simulation.ids()[i], 2 * i + 2);
    EXPECT_EQ(measured(simulation).particles, 10U);
    ASSERT_TRUE(simulation.apply_impulse(2, {0, 500, 0}));
    ASSERT_TRUE(advance(simulation, 20));
    EXPECT_EQ(simulation.particle_count(), 9U);
  }
}

// Pair tables are looked up by material; the last of many materials must find its own row.
TEST(CpuBackend, TellsManyMaterialsApart) {
  Scene scene = open_scene();
  scene.materials.clear();
  const int count = 300;
  for (int i = 0; i < count; ++i) {
    scene.materials.push_back({"m" + std::to_string(i), 0.5, 1, {100.0 + i, 0, 0}, 0, ""});
  }
  ParticleSet particles;
  for (int i = 0; i < count; ++i) {
    add(particles, {0, 0, -90 + 0.6 * i}, {0, 0, 0}, static_cast<std::uint16_t>(count - 1 - i));
  }
  Simulation reference = simulate(scene, particles, kReference);
  Simulation cpu = simulate(scene, particles, kCpuDouble);
  ASSERT_TRUE(advance(reference, 5));
  ASSERT_TRUE(advance(cpu, 5));
  EXPECT_EQ(reference.state_hash(), cpu.state_hash());
}

}  // namespace
}  // namespace hooke::test
