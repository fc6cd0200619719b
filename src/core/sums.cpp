// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/sums.h"

#include <algorithm>
#include <cmath>

#include "hooke/physics/contact.h"

namespace hooke {

void StepSums::add(const StepSums& other) {
  for (std::size_t cause = 0; cause < kCauses; ++cause) {
    power.of[cause].add(other.power.of[cause]);
    next_power.of[cause].add(other.next_power.of[cause]);
  }
  wall_force.add(other.wall_force);
  drag_force.add(other.drag_force);
  collider_force.add(other.collider_force);
}

namespace {

StepRates rates(const StepSums& sums, const ByCause<ExactSum>& twice_power, const Vec3d& gravity, double mass) {
  StepRates rates{{}, sums.wall_force.value(), sums.drag_force.value(), mass * gravity, sums.collider_force.value()};
  for (std::size_t cause = 0; cause < kCauses; ++cause) rates.power.of[cause] = 0.5 * twice_power.of[cause].value();
  return rates;
}

}  // namespace

StepRates first_rates(const StepSums& start, const Vec3d& gravity, double mass) {
  return rates(start, start.power, gravity, mass);
}

void book_step(Ledger& ledger, const StepSums& now, const Vec3d& gravity, double mass, double dt,
               Integrator integrator) {
  const auto book = [&ledger](const StepRates& rates, double seconds) {
    for (std::size_t cause = 0; cause < kCauses; ++cause) ledger.work.of[cause] += seconds * rates.power.of[cause];
    ledger.wall_impulse += seconds * rates.wall_force;
    ledger.collider_impulse += seconds * rates.collider_force;
    ledger.drag_impulse += seconds * rates.drag_force;
    ledger.gravity_impulse += seconds * rates.gravity_force;
  };
  if (integrator == Integrator::symplectic_euler) {
    book(rates(now, now.power, gravity, mass), dt);
    return;
  }
  book(ledger.last, dt / 2);
  book(rates(now, now.power, gravity, mass), dt / 2);
  ledger.last = rates(now, now.next_power, gravity, mass);
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
  count += other.count;
}

void RemovalSums::book(Ledger& ledger) const {
  ledger.removed_momentum += momentum.value();
  ledger.removed_energy += energy.value();
  ledger.removed += count;
}

void SpringSums::add(const SpringSums& other) {
  work.add(other.work);
  next_work.add(other.next_work);
  power.add(other.power);
  broken_energy.add(other.broken_energy);
  broken += other.broken;
}

void SpringSums::book(SpringLedger& ledger, double dt, Integrator integrator) const {
  ledger.broken += broken;
  ledger.broken_energy += broken_energy.value();
  if (integrator == Integrator::symplectic_euler) {
    ledger.work += dt / 2 * work.value();
    ledger.dissipated += dt * power.value();
    return;
  }
  ledger.work += ledger.next_work + dt / 4 * work.value();
  ledger.dissipated += dt / 2 * (ledger.last_power + power.value());
  book_first(ledger, dt);
}

void SpringSums::book_first(SpringLedger& ledger, double dt) const {
  ledger.next_work = dt / 4 * next_work.value();
  ledger.last_power = power.value();
}

void AttractionBooking::add(const AttractionBooking& other) {
  work.add(other.work);
  next_work.add(other.next_work);
  force.add(other.force);
}

void AttractionBooking::book(AttractionLedger& ledger, double dt, Integrator integrator) const {
  if (integrator == Integrator::symplectic_euler) {
    ledger.work += dt / 2 * work.value();
    ledger.impulse += dt * force.value();
    return;
  }
  ledger.work += ledger.next_work + dt / 4 * work.value();
  ledger.impulse += ledger.next_impulse + dt / 2 * force.value();
  book_first(ledger, dt);
}

void AttractionBooking::book_first(AttractionLedger& ledger, double dt) const {
  ledger.next_work = dt / 4 * next_work.value();
  ledger.next_impulse = dt / 2 * force.value();
}

void HoldSums::add_particle(double mass, const Vec3d& held, const Vec3d& kicked) {
  const Vec3d given = mass * (held - kicked);
  impulse.add(given);
  work.add(dot(given, held));
  ++count;
}

void HoldSums::add(const HoldSums& other) {
  impulse.add(other.impulse);
  work.add(other.work);
  count += other.count;
}

void HoldSums::book(HoldLedger& ledger, Integrator integrator) const {
  ledger.impulse += ledger.next_impulse + impulse.value();
  ledger.work += ledger.next_work + work.value();
  if (integrator == Integrator::velocity_verlet) book_first(ledger);
}

void HoldSums::book_first(HoldLedger& ledger) const {
  ledger.next_impulse = impulse.value();
  ledger.next_work = work.value();
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
