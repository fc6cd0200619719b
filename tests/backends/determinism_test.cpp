// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The same scene gives the same bits on any threads and instruction set, and whatever the caller does between steps.

#include <gtest/gtest.h>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "busy_scenes.h"
#include "hooke/backends/cpu/isa.h"

namespace hooke::test {
namespace {

constexpr std::int64_t kSteps = 100;

TEST_P(BusyScenes, HaveTheSameBitsForAnyNumberOfThreads) {
  Simulation one = simulate(scene_, particles_, engine(1));
  ASSERT_TRUE(advance(one, kSteps));
  EXPECT_GT(one.neighbour_statistics().rebuilds, 3U) << "lists are rebuilt on the way";
  if (GetParam().boundary == Boundary::open) {
    EXPECT_GT(one.ledger().removed, 10U);
  }
  if (GetParam().colliders) {
    for (const ColliderLoad& load : measured(one).colliders) EXPECT_GT(load.contacts, 0U) << "all are touched";
  }
  for (const int threads : {2, 3, 8}) {
    Simulation many = simulate(scene_, particles_, engine(threads));
    ASSERT_TRUE(advance(many, kSteps));
    EXPECT_EQ(many.backend_info().threads, threads);
    expect_same_bits(one, many);
  }
}

TEST_P(BusyScenes, HaveTheSameBitsOnEveryInstructionSetAndDevice) {
  Simulation widest = simulate(scene_, particles_, engine(2));
  ASSERT_TRUE(advance(widest, kSteps));
  for (const Engine& engine : engines_with_the_same_bits(GetParam().precision)) {
    SCOPED_TRACE(engine.name());
    Simulation other = simulate(scene_, particles_, engine);
    ASSERT_TRUE(advance(other, kSteps));
    if (engine.device == "cpu") {
      EXPECT_EQ(other.backend_info().isa, engine.isa);
    }
    expect_same_bits(widest, other);
  }
}

TEST_P(BusyScenes, HaveTheSameBitsHoweverStepsAreAskedFor) {
  Simulation at_once = simulate(scene_, particles_, engine(2));
  ASSERT_TRUE(advance(at_once, 60));
  Simulation one_by_one = simulate(scene_, particles_, engine(2));
  for (int i = 0; i < 60; ++i) {
    ASSERT_TRUE(advance(one_by_one, 1));
    (void)one_by_one.positions();  // reading positions changes nothing
    (void)one_by_one.state_hash();
    if (i % 7 == 0) (void)measured(one_by_one);  // may rebuild the list
  }
  EXPECT_EQ(at_once.state_hash(), one_by_one.state_hash());
  EXPECT_EQ(at_once.ledger(), one_by_one.ledger());
}

#if defined(__SSE2__)

class ControlRegister {
 public:
  explicit ControlRegister(unsigned mode) { _mm_setcsr(mode); }
  ~ControlRegister() { _mm_setcsr(saved_); }

 private:
  unsigned saved_ = _mm_getcsr();
};

// Games set flush-to-zero; some libraries leave another rounding mode behind. Neither changes Hooke's bits.
TEST_P(BusyScenes, HaveTheSameBitsUnderTheCallersFloatingPointModes) {
  Simulation usual = simulate(scene_, particles_, engine(2));
  ASSERT_TRUE(advance(usual, kSteps));
  for (const unsigned mode : {0x9fc0U /* flush to zero, denormals are zero */, 0x5f80U /* round up */}) {
    Simulation other = [&] {
      const ControlRegister set(mode);
      Simulation simulation = simulate(scene_, particles_, engine(2));
      EXPECT_TRUE(advance(simulation, kSteps));
      return simulation;
    }();
    expect_same_bits(usual, other);
    EXPECT_EQ(usual.initial_energy(), other.initial_energy());
  }
}

// Speeds so small that flush-to-zero would turn them into zeros.
TEST(FlushToZero, LeavesDenormalsAlone) {
  Scene scene = open_scene();
  scene.materials[0].drag = 100;
  ParticleSet particles;
  add(particles, {0, 0, 0}, {1e-300, 0, 0});
  add(particles, {2, 0, 0}, {1e-36, 0, 0});
  for (const Engine& engine : {kReference, kCpuDouble, kCpuSingle, kGpuDouble, kGpuSingle}) {
    const auto run = [&](unsigned mode) {
      const ControlRegister set(mode);
      Simulation simulation = simulate(scene, particles, engine);
      EXPECT_TRUE(advance(simulation, 300));
      return std::pair{simulation.state_hash(), simulation.ledger()};
    };
    EXPECT_EQ(run(0x1f80), run(0x9fc0)) << engine.name();
  }
}

#endif

TEST(TwoSimulations, DoNotDisturbEachOther) {
  const BusyKind kind{Boundary::open, Integrator::symplectic_euler, Precision::single_precision};
  const Scene scene = busy_scene(kind);
  const ParticleSet particles = busy_particles(scene);
  Simulation alone = simulate(scene, particles, {"cpu", kind.precision, 2, ""});
  ASSERT_TRUE(advance(alone, 40));
  Simulation a = simulate(scene, particles, {"cpu", kind.precision, 3, ""});
  Simulation b = simulate(scene, particles, {"cpu", kind.precision, 8, ""});
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(advance(a, 1));
    ASSERT_TRUE(advance(b, 1));
  }
  EXPECT_EQ(a.state_hash(), alone.state_hash());
  EXPECT_EQ(b.state_hash(), alone.state_hash());
}

INSTANTIATE_TEST_SUITE_P(Kinds, BusyScenes, all_busy_kinds(),
                         [](const auto& instance) { return instance.param.name(); });

}  // namespace
}  // namespace hooke::test
