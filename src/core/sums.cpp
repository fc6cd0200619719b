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

void AppliedSums::add_pinned(double mass, const Vec3d& pinned, const Vec3d& kicked, double seconds) {
  HOOKE_ASSERT(mass > 0 && seconds > 0, mass, seconds);
  const Vec3d given = (mass / seconds) * (pinned - kicked);
  Rates& hold = (*this)[Cause::hold];
  hold.force.add(given);
  hold.power.add(2 * dot(given, pinned));
  hold.next_power.add(2 * dot(given, pinned));
}

void AppliedSums::add(const AppliedSums& other) {
  for (std::size_t i = 0; i < of.size(); ++i) {
    of[i].power.add(other.of[i].power);
    of[i].next_power.add(other.of[i].next_power);
    of[i].force.add(other.of[i].force);
  }
  springs.add(other.springs);
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
  box_.add(x);
  ++particles_;
}

void MeasurementSums::add_contact_side(const ContactLaw<double>& law, double overlap, double reach) {
  HOOKE_ASSERT(reach > 0, reach);
  elastic_.add(0.5 * contact_energy(overlap, law));
  if (!(overlap > 0)) return;
  ++contact_sides_;
  overlap_ratio_.add(overlap / reach);
  max_pair_ratio_ = std::max(max_pair_ratio_, overlap / reach);
}

void MeasurementSums::add_wall_contact(const ContactLaw<double>& law, double overlap, double radius,
                                       const Vec3d& force) {
  HOOKE_ASSERT(radius > 0, radius);
  if (overlap > 0) ++wall_contacts_;
  max_body_ratio_ = std::max(max_body_ratio_, overlap / radius);
  wall_elastic_.add(contact_energy(overlap, law));
  wall_force_.add(force);
}

void MeasurementSums::add_collider_contact(std::size_t index, const Vec3d& point, const ContactLaw<double>& law,
                                           double overlap, double radius, const Vec3d& force) {
  HOOKE_ASSERT(radius > 0, radius);
  max_body_ratio_ = std::max(max_body_ratio_, overlap / radius);
  collider_elastic_.add(contact_energy(overlap, law));
  collider_loads_.add_contact(index, point, force);
}

void MeasurementSums::add_springs(std::uint64_t count, const ExactSum& energy) {
  springs_ += count;
  spring_energy_.add(energy);
}

void MeasurementSums::add(const MeasurementSums& other) {
  box_.add(other.box_);
  particles_ += other.particles_;
  contact_sides_ += other.contact_sides_;
  wall_contacts_ += other.wall_contacts_;
  springs_ += other.springs_;
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
  spring_energy_.add(other.spring_energy_);
  attraction_energy_.add(other.attraction_energy_);
  collider_loads_.add(other.collider_loads_);
  max_speed_ = std::max(max_speed_, other.max_speed_);
  max_pair_ratio_ = std::max(max_pair_ratio_, other.max_pair_ratio_);
  max_body_ratio_ = std::max(max_body_ratio_, other.max_body_ratio_);
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
  m.max_overlap_ratio = std::max(max_pair_ratio_, max_body_ratio_);
  m.max_pair_overlap_ratio = max_pair_ratio_;
  if (contact_sides_ > 0) m.mean_overlap_ratio = overlap_ratio_.value() / static_cast<double>(contact_sides_);
  if (particles_ > 0) {
    m.min = box_.min;
    m.max = box_.max;
  }
  m.wall_force = wall_force_.value();
  m.collider_elastic_energy = collider_elastic_.value();
  m.springs = springs_;
  m.spring_energy = spring_energy_.value();
  m.attraction_energy = attraction_energy_.value();
  m.colliders = collider_loads_.result(colliders);
  return m;
}

}  // namespace hooke
