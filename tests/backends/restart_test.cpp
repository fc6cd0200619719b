// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// N steps, a snapshot, and N more steps in another simulation give the bits of 2 N steps.

#include <gtest/gtest.h>

#include "busy_scenes.h"

namespace hooke::test {
namespace {

class Restarts : public BusyScenes {};

TEST_P(Restarts, GoOnWithTheSameBits) {
  for (const std::int64_t steps : {1, 7, 23, 50}) {
    Simulation whole = simulate(scene_, particles_, engine(2));
    ASSERT_TRUE(advance(whole, 2 * steps));

    Simulation first = simulate(scene_, particles_, engine(3));
    ASSERT_TRUE(advance(first, steps));
    const SimulationState saved = first.state();
    // A checkpoint of one device goes on on another.
    Simulation second = resume(scene_, saved, steps == 23 ? Engine{"gpu", GetParam().precision, 1, ""} : engine(1));
    EXPECT_EQ(second.state_hash(), first.state_hash()) << "as saved, after " << steps;
    EXPECT_EQ(second.ledger(), first.ledger());
    ASSERT_TRUE(advance(second, steps));
    EXPECT_EQ(second.step_count(), 2 * steps);
    EXPECT_EQ(second.initial_energy(), whole.initial_energy());
    EXPECT_EQ(second.initial_momentum(), whole.initial_momentum());
    expect_same_bits(whole, second);

    // Taking a snapshot changes nothing, and the first simulation can go back to it as well.
    ASSERT_TRUE(advance(first, steps));
    EXPECT_EQ(first.state_hash(), whole.state_hash());
    ASSERT_TRUE(first.restore(saved));
    EXPECT_EQ(first.step_count(), steps);
    ASSERT_TRUE(advance(first, steps));
    expect_same_bits(whole, first);
  }
}

// Edits, and the accelerations that new particles need under velocity Verlet, belong to the state.
TEST_P(Restarts, GoOnAfterEdits) {
  const auto edit = [](Simulation& s) {
    const NewParticle added[] = {{1, {0.5, 8.3, 0.5}, {0, -1, 0}}, {0, {1.5, 8.3, 0.5}, {0, 0, 0}}};
    EXPECT_TRUE(s.add_particles(added));
    const std::uint64_t gone[] = {s.ids()[3], s.ids()[100]};
    EXPECT_TRUE(s.remove_particles(gone));
    EXPECT_TRUE(s.apply_impulse(s.ids()[5], {0.1, 0.2, 0.3}));
  };
  Simulation whole = simulate(scene_, particles_, engine(2));
  ASSERT_TRUE(advance(whole, 10));
  edit(whole);
  const SimulationState saved = whole.state();
  ASSERT_TRUE(advance(whole, 20));
  Simulation second = resume(scene_, saved, engine(2));
  ASSERT_TRUE(advance(second, 20));
  expect_same_bits(whole, second);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Restarts, all_busy_kinds(), [](const auto& instance) { return instance.param.name(); });

TEST(ReferenceRestarts, GoOnWithTheSameBits) {
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
    Scene scene = busy_scene({Boundary::open, integrator, Precision::double_precision});
    const ParticleSet particles = lattice(scene, {5, 5, 5}, {-2.7, 0.4, -2.7}, 0.45, 0.1, 5);
    Simulation whole = simulate(scene, particles, kReference);
    ASSERT_TRUE(advance(whole, 60));
    Simulation first = simulate(scene, particles, kReference);
    ASSERT_TRUE(advance(first, 30));
    Simulation second = resume(scene, first.state(), kReference);
    ASSERT_TRUE(advance(second, 30));
    expect_same_bits(whole, second);
    // A state can go from one back end to another of the same precision.
    Simulation on_cpu = resume(scene, first.state(), kCpuDouble);
    ASSERT_TRUE(advance(on_cpu, 30));
    EXPECT_EQ(on_cpu.state_hash(), whole.state_hash());
  }
}

}  // namespace
}  // namespace hooke::test
