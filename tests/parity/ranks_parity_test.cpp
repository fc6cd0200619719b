// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The same bits on any number of ranks. Ranks are threads here; tests/mpi has processes.

#include <gtest/gtest.h>

#include <string>

#include "parity/scenarios.h"
#include "support/engines.h"
#include "support/ranks.h"
#include "support/same_bits.h"

namespace hooke::test {
namespace {

class OnRanks : public testing::TestWithParam<Scenario> {};

TEST_P(OnRanks, HasTheBitsOfOneRank) {
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
    for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
      Scene scene = GetParam().scene;
      scene.integrator = integrator;
      const Engine engine{"cpu", precision, 1, "", true};
      Simulation one = simulate(scene, GetParam().particles, engine);
      const auto one_steps = one.step(GetParam().steps);
      for (const int ranks : {2, 3, 4, 8}) {
        SCOPED_TRACE(testing::PrintToString(integrator) + ", " + testing::PrintToString(precision) + ", " +
                     std::to_string(ranks) + " ranks");
        on_ranks(ranks, scene, GetParam().particles, engine, [&](Simulation& many) {
          const auto many_steps = many.step(GetParam().steps);
          ASSERT_EQ(many_steps.has_value(), one_steps.has_value());
          if (!one_steps) {
            EXPECT_EQ(many_steps.error().text(), one_steps.error().text());
          }
          EXPECT_EQ(many.step_count(), one.step_count());
          EXPECT_EQ(many.state_hash(), one.state_hash());
          EXPECT_EQ(many.particle_count(), one.particle_count());
          EXPECT_EQ(many.ledger(), one.ledger());
          if (!one_steps) return;
          expect_same_bits(one, many);
          EXPECT_EQ(many.neighbour_statistics().missed_contacts, 0U);
        });
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, OnRanks, testing::ValuesIn(scenarios()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace hooke::test
