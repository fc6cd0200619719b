// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Single precision against the reference: one evaluation on the same positions, which single precision holds exactly.

#include <gtest/gtest.h>

#include <cmath>

#include "scenarios.h"
#include "support/engines.h"

namespace hooke::test {
namespace {

class SinglePrecision : public testing::TestWithParam<Scenario> {};

TEST_P(SinglePrecision, OneStepIsThatOfTheReferenceButForRounding) {
  const Scenario& scenario = GetParam();
  Simulation reference = simulate(scenario.scene, scenario.particles, kReference);
  Simulation single = simulate(scenario.scene, scenario.particles, kCpuSingle);
  const Measurements before = measured(reference);
  EXPECT_EQ(measured(single).contacts, before.contacts);
  const auto a = reference.step(), b = single.step();
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) GTEST_SKIP() << a.error().text();
  if (reference.particle_count() == 0) return;

  // Each contact's overlap is known to a few units in the last place of the distance, and such errors add up.
  constexpr double kUnit = 0x1p-24;
  double force = 0, lightest = INFINITY, fastest = measured(reference).max_speed;
  for (const Material& m : scenario.scene.materials) {
    force = std::max(force, 2 * m.radius * m.contact.stiffness + (m.contact.damping + m.contact.shear) * 2 * fastest);
    lightest = std::min(lightest, m.mass);
  }
  const auto n = static_cast<double>(reference.particle_count());
  const double contacts_each = 12 + 4 * static_cast<double>(before.contacts) / n;  // for one particle, at most
  const double allowed = kUnit * (8 * fastest + 8 * contacts_each * scenario.scene.time_step * force / lightest);
  ASSERT_EQ(reference.particle_count(), single.particle_count());
  for (std::size_t i = 0; i < reference.velocities().size(); ++i) {
    const Vec3d d = single.velocities()[i] - reference.velocities()[i];
    ASSERT_LE(std::sqrt(dot(d, d)), allowed) << "particle " << reference.ids()[i];
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, SinglePrecision, testing::ValuesIn(scenarios()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace hooke::test
