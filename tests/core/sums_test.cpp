// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/ledger_sums.h"

#include <gtest/gtest.h>

namespace hooke {
namespace {

// Powers of this kick and of the next, and forces, as one evaluation reports them for 2 kg.
StepReport report(double power, double next_power) {
  StepReport found;
  found.mass.add(2);
  StepSums& s = found.sums;
  for (std::size_t cause = 0; cause < kPassCauses; ++cause) {
    s.power.of[cause].add(2 * power * static_cast<double>(cause + 1));  // at twice the mean velocity
    s.next_power.of[cause].add(2 * next_power * static_cast<double>(cause + 1));
  }
  s.wall_force.add({3 * power, 0, 0});
  s.drag_force.add({0, 4 * power, 0});
  return found;
}

// With steps of half a second and a gravity of 5 m/s^2 along z.
Scene scene_of(Integrator integrator) {
  Scene scene;
  scene.gravity = {0, 0, 5};
  scene.time_step = 0.5;
  scene.integrator = integrator;
  return scene;
}

TEST(LedgerSums, BookAWholeStepUnderSymplecticEuler) {
  LedgerSums sums;
  sums.book_step(report(8, 1000), scene_of(Integrator::symplectic_euler));
  const Ledger ledger = sums.read();
  for (std::size_t cause = 0; cause < kPassCauses; ++cause) {
    EXPECT_EQ(ledger.work.of[cause], 4 * static_cast<double>(cause + 1));
  }
  EXPECT_EQ(ledger.impulse[Cause::wall].x, 12);
  EXPECT_EQ(ledger.impulse[Cause::drag].y, 16);
  EXPECT_EQ(ledger.impulse[Cause::gravity].z, 5);
  EXPECT_EQ(sums.kick_to_come, KickSums{}) << "it has none";
}

TEST(LedgerSums, BookHalvesOfTwoEvaluationsUnderVelocityVerlet) {
  const Scene scene = scene_of(Integrator::velocity_verlet);
  LedgerSums sums;
  sums.book_start(report(8, 1000), scene);
  sums.book_step(report(16, 32), scene);
  const Ledger first = sums.read();
  EXPECT_EQ(first.work.of[0], 2 + 4);
  EXPECT_EQ(first.impulse[Cause::wall].x, 6 + 12);
  EXPECT_EQ(first.impulse[Cause::gravity].z, 5);
  sums.book_step(report(64, 1000), scene);
  const Ledger second = sums.read();
  EXPECT_EQ(second.work.of[0], 2 + 4 + 8 + 16) << "the next power of the step before, then this one's";
  EXPECT_EQ(second.impulse[Cause::wall].x, 6 + 12 + 12 + 48) << "the force stays for both of its half kicks";
}

TEST(LedgerSums, BookAppliedCausesLikeTheOthers) {
  AppliedSums applied;
  applied[Cause::springs].power.add(2 * 8);
  applied[Cause::springs].next_power.add(2 * 32);
  applied[Cause::attraction].force.add({0, 0, 6});
  applied.springs.dissipation.add(10);
  applied.springs.broken_energy.add(3);
  applied.springs.broken = 2;
  applied.add_pinned(2, {1, 0, 0}, {4, 0, 0}, 0.25);  // -24 N, which moves at 1 m/s
  StepReport once, twice;
  once.applied = twice.applied = applied;
  twice.applied->add(applied);
  LedgerSums sums;
  const Scene scene = scene_of(Integrator::velocity_verlet);
  sums.book_start(once, scene);
  sums.book_step(twice, scene);
  const Ledger ledger = sums.read();
  EXPECT_EQ(ledger.work[Cause::springs], 0.25 * 8 + 0.25 * 16);
  EXPECT_EQ(sums.kick_to_come.twice_power[Cause::springs].value(), 2 * 64);
  EXPECT_EQ(ledger.work[Cause::hold], -0.25 * 24 - 0.25 * 48);
  EXPECT_EQ(ledger.impulse[Cause::hold].x, -0.25 * 24 - 0.25 * 48);
  EXPECT_EQ(ledger.impulse[Cause::attraction].z, 0.25 * 6 + 0.25 * 12);
  EXPECT_EQ(ledger.springs.dissipated, 0.25 * 10 + 0.25 * 20);
  EXPECT_EQ(ledger.springs.broken_energy, 6);
  EXPECT_EQ(ledger.springs.broken, 4U);
}

// Terms that cancel over a thousand steps leave what no sum of rounded steps would.
TEST(LedgerSums, RoundNothingUntilTheyAreRead) {
  const auto push = [](LedgerSums& sums, double newtons) {
    StepReport step;
    step.sums.wall_force.add({newtons, 0, 0});
    sums.book_step(step, scene_of(Integrator::symplectic_euler));
  };
  LedgerSums sums;
  push(sums, 1e20);
  for (int i = 0; i < 1000; ++i) push(sums, 0.5);
  push(sums, -1e20);
  EXPECT_EQ(sums.read().impulse[Cause::wall].x, 250);
}

TEST(LedgerSums, KeepWhatStepsOfAnotherLengthAndGravityDid) {
  Scene scene = scene_of(Integrator::symplectic_euler);
  LedgerSums sums;
  sums.book_step(report(8, 0), scene);
  scene.time_step = 0.25;
  scene.gravity = {0, 0, 10};
  sums.book_step(report(8, 0), scene);
  sums.book_step(report(8, 0), scene);
  const Ledger ledger = sums.read();
  EXPECT_EQ(ledger.work.of[0], 0.5 * 8 + 0.25 * 16);
  EXPECT_EQ(ledger.impulse[Cause::wall].x, 0.5 * 24 + 0.25 * 48);
  EXPECT_EQ(ledger.impulse[Cause::gravity].z, 0.5 * 2 * 5 + 0.25 * 2 * 20);
}

TEST(LedgerSums, OfTwoRanksAreThoseOfOne) {
  LedgerSums one, first, second;
  for (int i = 0; i < 12; ++i) {
    const StepReport step = report(0.1 * i, 0.7 * i);
    RemovalSums removed;
    removed.add_particle(0.1 * (i + 1), {0, 0.3, 0}, {0.7, 0, 0}, {0, -9.8, 0});
    for (LedgerSums* sums : {&one, i % 3 == 0 ? &first : &second}) {
      if (i < 10) sums->book_step(step, scene_of(Integrator::symplectic_euler));
      sums->book_left(removed);
      if (i % 2 == 0) sums->book_sunk(removed);
      if (i % 4 == 0) sums->book_expired(removed);
      sums->book_born(removed);
    }
  }
  first.add(second);
  EXPECT_EQ(first, one);
  const Ledger ledger = first.read();
  EXPECT_EQ(ledger.removed, 12U);
  EXPECT_EQ(ledger.population.sunk, 6U);
  EXPECT_EQ(ledger.population.expired, 3U);
  EXPECT_EQ(ledger.population.born, 12U);
}

TEST(Ledger, CallsDissipatedWhatDashpotsAndDragTookOut) {
  Ledger ledger;
  ledger.work[Cause::contact_spring] = 100;
  ledger.work[Cause::contact_shear] = -1;
  ledger.work[Cause::contact_damping] = -2;
  ledger.work[Cause::drag] = -4;
  ledger.work[Cause::wall] = -1000;
  EXPECT_EQ(ledger.dissipated(), 7);
}

TEST(MeasurementSums, SumUpInAnyOrderAndSplit) {
  const auto add = [](MeasurementSums& sums, int i) {
    const double x = 0.1 * i;
    sums.add_particle(1 + x, {x, -x, 1 / (1 + x)}, {x, 2 * x, -x}, {0, -9.8, 0});
    sums.add_contact_side({{1000, 0, 0}, {}}, 0.01 * (i + 1), 1);
    sums.add_wall_contact({{500, 0, 0}, {}}, 0.02 * (i + 1), 0.5, {0, x, 0});
  };
  MeasurementSums forward, backward, first, second;
  for (int i = 0; i < 100; ++i) add(forward, i);
  for (int i = 100; i-- > 0;) add(backward, i);
  for (int i = 0; i < 100; ++i) add(i % 3 == 0 ? first : second, i);
  second.add(first);
  second.add(MeasurementSums{});
  for (const Measurements& m : {backward.result(0), second.result(0)}) {
    const Measurements n = forward.result(0);
    EXPECT_EQ(m.particles, 100U);
    EXPECT_EQ(m.contacts, 50U) << "each from both sides";
    EXPECT_EQ(m.wall_contacts, 100U);
    EXPECT_EQ(m.kinetic_energy, n.kinetic_energy);
    EXPECT_EQ(m.potential_energy, n.potential_energy);
    EXPECT_EQ(m.elastic_energy, n.elastic_energy);
    EXPECT_EQ(m.wall_elastic_energy, n.wall_elastic_energy);
    EXPECT_EQ(m.momentum, n.momentum);
    EXPECT_EQ(m.centre_of_mass, n.centre_of_mass);
    EXPECT_EQ(m.mean_overlap_ratio, n.mean_overlap_ratio);
    EXPECT_EQ(m.max_pair_overlap_ratio, 1);
    EXPECT_EQ(m.max_overlap_ratio, 4) << "of walls";
    EXPECT_EQ(m.min, n.min);
    EXPECT_EQ(m.max, (Vec3d{0.1 * 99, 0, 1}));
    EXPECT_EQ(m.wall_force, n.wall_force);
  }
}

TEST(MeasurementSums, OfNothingAreZeros) {
  const Measurements m = MeasurementSums{}.result(0);
  EXPECT_EQ(m.particles, 0U);
  EXPECT_EQ(m.kinetic_energy, 0);
  EXPECT_EQ(m.mean_overlap_ratio, 0);
  EXPECT_EQ(m.centre_of_mass, (Vec3d{0, 0, 0}));
  EXPECT_EQ(m.min, (Vec3d{0, 0, 0}));
}

TEST(LedgerSums, BookWhatDepartedTookAlong) {
  RemovalSums removed;
  removed.add_particle(2, {0, 10, 0}, {3, 0, 0}, {0, -10, 0});
  removed.elastic.add(0.5);
  LedgerSums sums;
  sums.book_left(removed);
  Ledger ledger = sums.read();
  EXPECT_EQ(ledger.removed, 1U);
  EXPECT_EQ(ledger.removed_momentum, (Vec3d{6, 0, 0}));
  EXPECT_EQ(ledger.removed_energy, 9 + 200);
  EXPECT_EQ(ledger.removed_elastic, 0.5);
  sums.book_born(removed);
  ledger = sums.read();
  EXPECT_EQ(ledger.population.born, 1U);
  EXPECT_EQ(ledger.population.born_energy, 9 + 200);
  EXPECT_EQ(ledger.removed_elastic, 0);
}

}  // namespace
}  // namespace hooke
