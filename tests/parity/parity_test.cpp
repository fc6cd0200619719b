// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The fast back end against the reference: in double precision the same bits, on every instruction set.

#include <gtest/gtest.h>

#include <cmath>

#include "hooke/backends/cpu/isa.h"
#include "scenarios.h"
#include "support/engines.h"

namespace hooke::test {
namespace {

class Parity : public testing::TestWithParam<std::tuple<Scenario, Integrator>> {
 protected:
  Parity() : scenario_(std::get<0>(GetParam())) { scenario_.scene.integrator = std::get<1>(GetParam()); }

  Scenario scenario_;
};

// One step on each; both must succeed, or both must fail with the same words.
bool step_both(Simulation& a, Simulation& b) {
  const auto on_a = a.step(), on_b = b.step();
  EXPECT_EQ(on_a.has_value(), on_b.has_value());
  if (!on_a && !on_b) {
    EXPECT_EQ(on_a.error().text(), on_b.error().text());
  }
  return on_a.has_value() && on_b.has_value();
}

void expect_same_figures(const Simulation& a, const Simulation& b) {
  const Measurements m = measured(a), n = measured(b);
  EXPECT_EQ(m.particles, n.particles);
  EXPECT_EQ(m.contacts, n.contacts);
  EXPECT_EQ(m.wall_contacts, n.wall_contacts);
  EXPECT_EQ(m.max_speed, n.max_speed);
  EXPECT_EQ(m.max_overlap_ratio, n.max_overlap_ratio);
  EXPECT_EQ(m.min, n.min);
  EXPECT_EQ(m.max, n.max);
  // Sums agree to 1e-12 of their terms across back ends.
  const auto near = [](double x, double y, double scale) { EXPECT_NEAR(x, y, 1e-12 * (std::abs(x) + scale)); };
  near(m.kinetic_energy, n.kinetic_energy, 0);
  near(m.elastic_energy, n.elastic_energy, 0);
  near(m.wall_elastic_energy, n.wall_elastic_energy, 0);
  near(m.potential_energy, n.potential_energy, 0);
  near(m.momentum.x, n.momentum.x, m.momentum_scale);
  double scale = m.kinetic_energy;
  for (const double work : a.ledger().work.of) scale += std::abs(work);
  for (std::size_t cause = 0; cause < kCauses; ++cause) {
    near(a.ledger().work.of[cause], b.ledger().work.of[cause], scale);
  }
  near(a.ledger().impulse[Cause::wall].y, b.ledger().impulse[Cause::wall].y, m.momentum_scale);
  near(a.ledger().impulse[Cause::collider].y, b.ledger().impulse[Cause::collider].y, m.momentum_scale);
  near(m.collider_elastic_energy, n.collider_elastic_energy, 0);
  ASSERT_EQ(m.colliders.size(), n.colliders.size());
  for (std::size_t c = 0; c < m.colliders.size(); ++c) {
    EXPECT_EQ(m.colliders[c].contacts, n.colliders[c].contacts);
    near(m.colliders[c].force.y, n.colliders[c].force.y, m.momentum_scale);
    near(m.colliders[c].torque.x, n.colliders[c].torque.x, m.momentum_scale);
  }
  near(a.ledger().impulse[Cause::gravity].y, b.ledger().impulse[Cause::gravity].y, 0);
  near(a.ledger().impulse[Cause::drag].x, b.ledger().impulse[Cause::drag].x, m.momentum_scale);
  near(a.ledger().removed_energy, b.ledger().removed_energy, m.kinetic_energy);
  EXPECT_EQ(a.ledger().removed, b.ledger().removed);
}

TEST_P(Parity, CpuInDoubleHasTheBitsOfTheReference) {
  for (const Isa& isa : available_isas()) {
    SCOPED_TRACE(isa.name);
    Simulation reference = simulate(scenario_.scene, scenario_.particles, kReference);
    Simulation cpu = simulate(scenario_.scene, scenario_.particles, {"cpu", Precision::double_precision, 2, isa.name});
    ASSERT_EQ(reference.state_hash(), cpu.state_hash());
    for (std::int64_t step = 1; step <= scenario_.steps; ++step) {
      if (!step_both(reference, cpu)) break;
      ASSERT_EQ(reference.state_hash(), cpu.state_hash()) << "after step " << step;
    }
    const ParticleSet &p = reference.particles(), &q = cpu.particles();
    EXPECT_EQ(p.id, q.id);
    EXPECT_EQ(p.material, q.material);
    EXPECT_EQ(p.position, q.position);
    EXPECT_EQ(p.velocity, q.velocity);
    EXPECT_EQ(p.acceleration, q.acceleration);
    if (!HasFailure() && reference.measure().has_value()) expect_same_figures(reference, cpu);
  }
}

TEST_P(Parity, CpuInSingleHasTheSameBitsOnEveryInstructionSet) {
  std::uint64_t expected = 0;
  for (const Isa& isa : available_isas()) {
    Simulation cpu = simulate(scenario_.scene, scenario_.particles, {"cpu", Precision::single_precision, 2, isa.name});
    (void)cpu.step(scenario_.steps);  // may fail
    std::uint64_t hash = 0;
    for (const Vec3d& x : cpu.positions()) hash += std::hash<double>{}(x.x) ^ std::hash<double>{}(x.y + 3 * x.z);
    hash += cpu.state_hash();
    if (expected == 0) expected = hash;
    EXPECT_EQ(hash, expected) << isa.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Parity,
                         testing::Combine(testing::ValuesIn(scenarios()),
                                          testing::Values(Integrator::symplectic_euler, Integrator::velocity_verlet)),
                         [](const auto& instance) {
                           const bool verlet = std::get<1>(instance.param) == Integrator::velocity_verlet;
                           return std::get<0>(instance.param).name + (verlet ? "_verlet" : "_euler");
                         });

}  // namespace
}  // namespace hooke::test
