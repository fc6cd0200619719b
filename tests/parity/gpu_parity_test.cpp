// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The back end of a GPU, with a loop in place of one, has the CPU's bits: states, ledgers, figures, and what it says of
// runs that go bad, whatever the order of its items.

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace hooke::test
