// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/sums.h"

#include <algorithm>
#include <cmath>

#include "hooke/base/assert.h"
#include "hooke/physics/contact.h"

namespace hooke {

void StepSums::add(const StepSums& other) {
  for (std::size_t cause = 0; cause < kPassCauses; ++cause) {
    power.of[cause].add(other.power.of[cause]);
    next_power.of[cause].add(other.next_power.of[cause]);
  }
  wall_force.add(other.wall_force);
  drag_force.add(other.drag_force);
  collider_force.add(other.collider_force);
}

void SpringSums::add(const SpringSums& other) {
  dissipation.add(other.dissipation);
  broken_energy.add(other.broken_energy);
  broken += other.broken;
}

void AppliedSums::add_held(double mass, const Vec3d& held, const Vec3d& kicked, double seconds) {
  HOOKE_ASSERT(mass > 0 && seconds > 0, mass, seconds);
  const Vec3d given = (mass / seconds) * (held - kicked);
  Rates& hold = (*this)[Cause::hold];
  hold.force.add(given);
  hold.power.add(2 * dot(given, held));
  hold.next_power.add(2 * dot(given, held));
}

void AppliedSums::add(const AppliedSums& other) {
  for (std::size_t i = 0; i < of.size(); ++i) {
    of[i].power.add(other.of[i].power);
    of[i].next_power.add(other.of[i].next_power);
    of[i].force.add(other.of[i].force);
  }
  springs.add(other.springs);
}

namespace {

enum class Kick { of_the_evaluation, next };

StepRates rates(const StepReport& report, Kick kick, const Vec3d& gravity) {
  const StepSums& sums = report.sums;
  StepRates rates;
  const bool next = kick == Kick::next;
  const ByCause<ExactSum, kPassCauses>& twice_power = next ? sums.next_power : sums.power;
  for (std::size_t c = 0; c < kPassCauses; ++c) rates.power.of[c] = 0.5 * twice_power.of[c].value();
  rates.force[Cause::wall] = sums.wall_force.value();
  rates.force[Cause::drag] = sums.drag_force.value();
  rates.force[Cause::collider] = sums.collider_force.value();
  rates.force[Cause::gravity] = report.mass * gravity;
  if (!report.applied) return rates;
  for (std::size_t i = 0; i < report.applied->of.size(); ++i) {
    const AppliedSums::Rates& of = report.applied->of[i];
    rates.power.of[kPassCauses + i] = 0.5 * (next ? of.next_power : of.power).value();
    rates.force.of[kPassCauses + i] = of.force.value();
  }
  rates.spring_dissipation = report.applied->springs.dissipation.value();
  return rates;
}

}  // namespace

StepRates first_rates(const StepReport& start, const Vec3d& gravity) {
  return rates(start, Kick::of_the_evaluation, gravity);
}

void book_step(Ledger& ledger, const StepReport& now, const Vec3d& gravity, double dt, Integrator integrator) {
  HOOKE_ASSERT(dt > 0 && now.mass >= 0, dt, now.mass);
  const auto book = [&ledger](const StepRates& rates, double seconds) {
    for (std::size_t cause = 0; cause < kCauses; ++cause) {
      ledger.work.of[cause] += seconds * rates.power.of[cause];
      ledger.impulse.of[cause] += seconds * rates.force.of[cause];
    }
    ledger.springs.dissipated += seconds * rates.spring_dissipation;
  };
  if (now.applied) {
    ledger.springs.broken += now.applied->springs.broken;
    ledger.springs.broken_energy += now.applied->springs.broken_energy.value();
  }
  const StepRates this_kick = rates(now, Kick::of_the_evaluation, gravity);
  if (integrator == Integrator::symplectic_euler) return book(this_kick, dt);
  book(ledger.last, dt / 2);
  book(this_kick, dt / 2);
  ledger.last = rates(now, Kick::next, gravity);
}

void RemovalSums::add_particle(double mass, const Vec3d& x, const Vec3d& v, const Vec3d& gravity) {
  momentum.add(mass * v);
  energy.add(0.5 * mass * dot(v, v));
  energy.add(-mass * dot(gravity, x));
  ++count;
}

void RemovalSums::add(const RemovalSums& other) {
  momentum.add(other.momentum);
  energy.add(other.energy);
  elastic.add(other.elastic);
  count += other.count;
}

void RemovalSums::book(Ledger& ledger) const { book_gone(ledger, ledger.removed); }

void RemovalSums::book_gone(Ledger& ledger, std::uint64_t& tally) const {
  ledger.removed_momentum += momentum.value();
  ledger.removed_energy += energy.value();
  ledger.removed_elastic += elastic.value();
  tally += count;
}

void RemovalSums::book_born(Ledger& ledger) const {
  ledger.population.born_momentum += momentum.value();
  ledger.population.born_energy += energy.value();
  ledger.population.born += count;
  ledger.removed_elastic -= elastic.value();
}

void ColliderLoadSums::add_contact(std::size_t index, const Vec3d& point, const Vec3d& force) {
  Load& load = loads_[index];
  load.force.add(-force);
  load.torque.add(cross(point, -force));
  ++load.contacts;
}

void ColliderLoadSums::add(const ColliderLoadSums& other) {
  for (const auto& [index, theirs] : other.loads_) {
    Load& load = loads_[index];
    load.force.add(theirs.force);
    load.torque.add(theirs.torque);
    load.contacts += theirs.contacts;
  }
}

std::vector<ColliderLoad> ColliderLoadSums::result(std::size_t count) const {
  HOOKE_ASSERT(loads_.empty() || loads_.rbegin()->first < count, loads_.rbegin()->first, count);
  std::vector<ColliderLoad> all(count);
  for (const auto& [index, load] : loads_) all[index] = {load.force.value(), load.torque.value(), load.contacts};
  return all;
}

void MeasurementSums::add_particle(double mass, const Vec3d& x, const Vec3d& v, const Vec3d& gravity) {
  const double speed = std::sqrt(dot(v, v));
  mass_.add(mass);
  kinetic_.add(0.5 * mass * dot(v, v));
  potential_.add(-mass * dot(gravity, x));
  momentum_.add(mass * v);
  mass_moment_.add(mass * x);
  momentum_scale_.add(mass * speed);
  max_speed_ = std::max(max_speed_, speed);
  const auto grow = [&](double Vec3d::* c) {
    min_.*c = particles_ == 0 ? x.*c : std::min(min_.*c, x.*c);
    max_.*c = particles_ == 0 ? x.*c : std::max(max_.*c, x.*c);
  };
  grow(&Vec3d::x);
  grow(&Vec3d::y);
  grow(&Vec3d::z);
  ++particles_;
}

void MeasurementSums::add_contact_side(const ContactLaw<double>& law, double overlap, double reach) {
  HOOKE_ASSERT(reach > 0, reach);
  elastic_.add(0.5 * contact_energy(overlap, law));
  if (!(overlap > 0)) return;
  ++contact_sides_;
  overlap_ratio_.add(overlap / reach);
  max_overlap_ratio_ = std::max(max_overlap_ratio_, overlap / reach);
}

void MeasurementSums::add_wall_contact(const ContactLaw<double>& law, double overlap, const Vec3d& force) {
  if (overlap > 0) ++wall_contacts_;
  wall_elastic_.add(contact_energy(overlap, law));
  wall_force_.add(force);
}

void MeasurementSums::add_collider_contact(std::size_t index, const Vec3d& point, const ContactLaw<double>& law,
                                           double overlap, const Vec3d& force) {
  collider_elastic_.add(contact_energy(overlap, law));
  collider_loads_.add_contact(index, point, force);
}

void MeasurementSums::add(const MeasurementSums& other) {
  if (other.particles_ > 0) {
    const auto grow = [&](double Vec3d::* c) {
      min_.*c = particles_ == 0 ? other.min_.*c : std::min(min_.*c, other.min_.*c);
      max_.*c = particles_ == 0 ? other.max_.*c : std::max(max_.*c, other.max_.*c);
    };
    grow(&Vec3d::x);
    grow(&Vec3d::y);
    grow(&Vec3d::z);
  }
  particles_ += other.particles_;
  contact_sides_ += other.contact_sides_;
  wall_contacts_ += other.wall_contacts_;
  mass_.add(other.mass_);
  kinetic_.add(other.kinetic_);
  potential_.add(other.potential_);
  elastic_.add(other.elastic_);
  wall_elastic_.add(other.wall_elastic_);
  overlap_ratio_.add(other.overlap_ratio_);
  momentum_scale_.add(other.momentum_scale_);
  momentum_.add(other.momentum_);
  mass_moment_.add(other.mass_moment_);
  wall_force_.add(other.wall_force_);
  collider_elastic_.add(other.collider_elastic_);
  collider_loads_.add(other.collider_loads_);
  max_speed_ = std::max(max_speed_, other.max_speed_);
  max_overlap_ratio_ = std::max(max_overlap_ratio_, other.max_overlap_ratio_);
}

Measurements MeasurementSums::result(std::size_t colliders) const {
  Measurements m;
  m.particles = particles_;
  m.contacts = contact_sides_ / 2;
  m.wall_contacts = wall_contacts_;
  m.kinetic_energy = kinetic_.value();
  m.potential_energy = potential_.value();
  m.elastic_energy = elastic_.value();
  m.wall_elastic_energy = wall_elastic_.value();
  m.momentum = momentum_.value();
  if (particles_ > 0) m.centre_of_mass = (1 / mass_.value()) * mass_moment_.value();
  m.momentum_scale = momentum_scale_.value();
  m.max_speed = max_speed_;
  m.max_overlap_ratio = max_overlap_ratio_;
  if (contact_sides_ > 0) m.mean_overlap_ratio = overlap_ratio_.value() / static_cast<double>(contact_sides_);
  m.min = min_;
  m.max = max_;
  m.wall_force = wall_force_.value();
  m.collider_elastic_energy = collider_elastic_.value();
  m.colliders = collider_loads_.result(colliders);
  return m;
}

}  // namespace hooke
