// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <chrono>

#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

using Clock = std::chrono::steady_clock;

class StageTimesOf : public testing::TestWithParam<std::tuple<Engine, Integrator>> {
 protected:
  Simulation make_simulation() const {
    const auto& [engine, integrator] = GetParam();
    Scene scene = open_scene();
    scene.integrator = integrator;
    const int side = engine.device == "reference" ? 8 : 24;
    return simulate(scene, lattice(scene, {side, side, side}, {-5, -5, -5}, 0.9, 0.1, 1), engine);
  }
};

TEST_P(StageTimesOf, StepsAreMostOfTheirTimeAndNoMore) {
  Simulation simulation = make_simulation();
  const Clock::time_point start = Clock::now();
  ASSERT_TRUE(advance(simulation, 100));
  const double whole = std::chrono::duration<double>(Clock::now() - start).count();
  const StageTimes times = simulation.stage_times();
  EXPECT_LE(times.total(), whole);
  EXPECT_GT(times.total(), 0.5 * whole);
  EXPECT_GT(times.force, 0);
  EXPECT_EQ(times.drift > 0, std::get<Integrator>(GetParam()) == Integrator::velocity_verlet);
}

TEST_P(StageTimesOf, LooksAndRestoresAreNoSteps) {
  Simulation simulation = make_simulation();
  EXPECT_EQ(simulation.stage_times().total(), 0) << "making it has built a list";
  ASSERT_TRUE(advance(simulation, 3));
  const double before = simulation.stage_times().total();
  ASSERT_TRUE(simulation.restore(simulation.state()));
  measured(simulation);
  EXPECT_EQ(simulation.stage_times().total(), before);
}

INSTANTIATE_TEST_SUITE_P(All, StageTimesOf,
                         testing::Combine(testing::Values(kReference, kCpuDouble, kCpuSingle),
                                          testing::Values(Integrator::symplectic_euler, Integrator::velocity_verlet)),
                         [](const auto& test) {
                           const bool verlet = std::get<1>(test.param) == Integrator::velocity_verlet;
                           return std::get<0>(test.param).name() + (verlet ? "_verlet" : "_euler");
                         });

}  // namespace
}  // namespace hooke::test
