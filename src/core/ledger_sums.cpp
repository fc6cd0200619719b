// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/ledger_sums.h"

#include "hooke/base/assert.h"

namespace hooke {

namespace {

enum class Kick { of_the_evaluation, next };

void add_kick(KickSums& sums, const StepReport& report, const Vec3d& gravity, Kick kick) {
  const bool next = kick == Kick::next;
  const StepSums& of = report.sums;
  for (std::size_t c = 0; c < kPassCauses; ++c) sums.twice_power.of[c].add((next ? of.next_power : of.power).of[c]);
  sums.force[Cause::wall].add(of.wall_force);
  sums.force[Cause::drag].add(of.drag_force);
  sums.force[Cause::collider].add(of.collider_force);
  for (int axis = 0; axis < 3; ++axis) {
    const double along = component(gravity, axis);
    if (along != 0) sums.force[Cause::gravity][axis].add_scaled(report.mass, along);
  }
  if (!report.applied) return;
  for (std::size_t i = 0; i < report.applied->of.size(); ++i) {
    const AppliedSums::Rates& rates = report.applied->of[i];
    sums.twice_power.of[kPassCauses + i].add(next ? rates.next_power : rates.power);
    sums.force.of[kPassCauses + i].add(rates.force);
  }
  sums.spring_dissipation.add(report.applied->springs.dissipation);
}

void add_kicks(KickSums& sums, const KickSums& other) {
  for (std::size_t cause = 0; cause < kCauses; ++cause) {
    sums.twice_power.of[cause].add(other.twice_power.of[cause]);
    sums.force.of[cause].add(other.force.of[cause]);
  }
  sums.spring_dissipation.add(other.spring_dissipation);
}

}  // namespace

void LedgerSums::book_step(const StepReport& now, const Scene& scene) {
  const bool verlet = scene.integrator == Integrator::velocity_verlet;
  settle(verlet ? scene.time_step / 2 : scene.time_step);
  if (now.applied) {
    broken += now.applied->springs.broken;
    broken_energy.add(now.applied->springs.broken_energy);
  }
  if (verlet) {
    add_kicks(kicks, kick_to_come);
    kick_to_come = {};
    add_kick(kick_to_come, now, scene.gravity, Kick::next);
  }
  add_kick(kicks, now, scene.gravity, Kick::of_the_evaluation);
}

void LedgerSums::book_start(const StepReport& start, const Scene& scene) {
  kick_to_come = {};
  add_kick(kick_to_come, start, scene.gravity, Kick::of_the_evaluation);
}

// Before kicks of another length.
void LedgerSums::settle(double next_kick) {
  HOOKE_ASSERT(next_kick > 0, next_kick);
  if (next_kick == kick) return;
  for_each_sum_of_kicks([this](ExactSum& total, const ExactSum& sum) { total.add_scaled(sum, kick); }, settled, kicks);
  kicks = {};
  kick = next_kick;
}

void LedgerSums::add(const LedgerSums& other) {
  HOOKE_ASSERT(kick == other.kick, kick, other.kick);
  for_each_sum([](ExactSum& sum, const ExactSum& more) { sum.add(more); }, *this, other);
  for_each_count([](std::uint64_t& count, const std::uint64_t& more) { count += more; }, *this, other);
}

Ledger LedgerSums::read() const {
  Ledger ledger;
  for (std::size_t cause = 0; cause < kCauses; ++cause) {
    ledger.work.of[cause] = 0.5 * (settled.twice_power.of[cause].value() + kick * kicks.twice_power.of[cause].value());
    ledger.impulse.of[cause] = settled.force.of[cause].value() + kick * kicks.force.of[cause].value();
  }
  ledger.removed_momentum = departed.momentum.value();
  ledger.removed_energy = departed.energy.value();
  ledger.removed_elastic = departed.elastic.value() - born.elastic.value();
  ledger.removed = departed.count - expired - sunk;
  ledger.population = {born.momentum.value(), born.energy.value(), born.count, expired, sunk};
  ledger.springs = {settled.spring_dissipation.value() + kick * kicks.spring_dissipation.value(), broken_energy.value(),
                    broken};
  return ledger;
}

}  // namespace hooke
