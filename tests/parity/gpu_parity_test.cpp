// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The back end of a GPU, with a loop in place of one, has the CPU's bits: states, ledgers, figures, and what it says of
// runs that go bad, whatever the order of its items.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "scenarios.h"
#include "support/engines.h"

namespace hooke::test {
namespace {

using gpu::ItemOrder;

class Gpu : public testing::TestWithParam<Scenario> {};

TEST_P(Gpu, HasTheBitsOfTheCpuInAnyOrderOfItems) {
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
    for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
      SCOPED_TRACE(testing::PrintToString(integrator) + ", " + testing::PrintToString(precision));
      Scene scene = GetParam().scene;
      scene.integrator = integrator;
      Simulation cpu = simulate(scene, GetParam().particles, {"cpu", precision, 1, ""});
      const auto cpu_steps = cpu.step(GetParam().steps);
      const auto cpu_figures = cpu.measure();
      for (const ItemOrder order : {ItemOrder::up, ItemOrder::down, ItemOrder::shuffled}) {
        Simulation gpu = simulate(scene, GetParam().particles, {"gpu", precision, 1, "", false, order});
        const auto gpu_steps = gpu.step(GetParam().steps);
        ASSERT_EQ(gpu_steps.has_value(), cpu_steps.has_value());
        if (!cpu_steps) {
          EXPECT_EQ(gpu_steps.error().text(), cpu_steps.error().text());
        }
        EXPECT_EQ(gpu.state_hash(), cpu.state_hash());
        EXPECT_EQ(gpu.ledger(), cpu.ledger());
        const auto gpu_figures = gpu.measure();
        ASSERT_EQ(gpu_figures.has_value(), cpu_figures.has_value());
        if (cpu_figures) {
          EXPECT_EQ(gpu_figures->kinetic_energy, cpu_figures->kinetic_energy);
          EXPECT_EQ(gpu_figures->elastic_energy, cpu_figures->elastic_energy);
          EXPECT_EQ(gpu_figures->contacts, cpu_figures->contacts);
          EXPECT_EQ(gpu_figures->wall_force, cpu_figures->wall_force);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Gpu, testing::ValuesIn(scenarios()),
                         [](const auto& instance) { return instance.param.name; });

// Items of a kernel at the same time on several threads: what the thread sanitizer says of them is what a GPU would do.
class GpuOnThreads : public testing::TestWithParam<std::string> {};

TEST_P(GpuOnThreads, HasTheBitsOfTheCpu) {
  const auto scenario = std::find_if(scenarios().begin(), scenarios().end(),
                                     [](const Scenario& candidate) { return candidate.name == GetParam(); });
  ASSERT_NE(scenario, scenarios().end());
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
    Scene scene = scenario->scene;
    scene.integrator = integrator;
    Simulation cpu = simulate(scene, scenario->particles, kCpuSingle);
    Simulation gpu =
        simulate(scene, scenario->particles, {"gpu", Precision::single_precision, 1, "", false, ItemOrder::threads});
    ASSERT_TRUE(advance(cpu, 12));
    ASSERT_TRUE(advance(gpu, 12));
    EXPECT_EQ(gpu.state_hash(), cpu.state_hash());
    EXPECT_EQ(gpu.ledger(), cpu.ledger());
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, GpuOnThreads,
                         testing::Values("colliders_open", "surfaces_periodic", "one_to_twelve_spring"),
                         [](const auto& instance) { return instance.param; });

#if defined(__SANITIZE_THREAD__)
// Adds to one number without an atomic operation.
struct PlantedRace {
  std::uint32_t* sum;
  void operator()(std::uint32_t i) const { *sum += i; }
};

TEST(GpuOnThreadsDeathTest, APlantedRaceIsFound) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto race = [] {
    std::uint32_t sum = 0;
    gpu::HostDevice(ItemOrder::threads).each(30000, PlantedRace{&sum});
    std::exit(0);
  };
  EXPECT_EXIT(race(), [](int status) { return status != 0; }, "data race");
}
#endif

}  // namespace
}  // namespace hooke::test
