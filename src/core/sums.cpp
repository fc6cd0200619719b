// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/sums.h"

#include <algorithm>
#include <cmath>

#include "hooke/base/assert.h"
#include "hooke/base/bytes.h"
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

void ColliderLoadSums::write(std::vector<std::byte>& to) const {
  for (const auto& [index, load] : loads_) {
    append_bytes(to, static_cast<std::uint64_t>(index));
    append_bytes(to, load);
  }
}

void ColliderLoadSums::read(std::span<const std::byte> from) {
  while (!from.empty()) {
    std::uint64_t index = 0;
    take_bytes(from, index);
    take_bytes(from, loads_[static_cast<std::size_t>(index)]);
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
  totals_.mass.add(mass);
  totals_.kinetic.add(0.5 * mass * dot(v, v));
  totals_.potential.add(-mass * dot(gravity, x));
  totals_.momentum.add(mass * v);
  totals_.mass_moment.add(mass * x);
  totals_.momentum_scale.add(mass * speed);
  totals_.max_speed = std::max(totals_.max_speed, speed);
  totals_.box.add(x);
  ++totals_.particles;
}

void MeasurementSums::add_contact_side(const ContactLaw<double>& law, double overlap, double reach) {
  HOOKE_ASSERT(reach > 0, reach);
  totals_.elastic.add(0.5 * contact_energy(overlap, law));
  if (!(overlap > 0)) return;
  ++totals_.contact_sides;
  totals_.overlap_ratio.add(overlap / reach);
  totals_.max_pair_ratio = std::max(totals_.max_pair_ratio, overlap / reach);
}

void MeasurementSums::add_wall_contact(const ContactLaw<double>& law, double overlap, double radius,
                                       const Vec3d& force) {
  HOOKE_ASSERT(radius > 0, radius);
  if (overlap > 0) ++totals_.wall_contacts;
  totals_.max_body_ratio = std::max(totals_.max_body_ratio, overlap / radius);
  totals_.wall_elastic.add(contact_energy(overlap, law));
  totals_.wall_force.add(force);
}

void MeasurementSums::add_collider_contact(std::size_t index, const Vec3d& point, const ContactLaw<double>& law,
                                           double overlap, double radius, const Vec3d& force) {
  HOOKE_ASSERT(radius > 0, radius);
  totals_.max_body_ratio = std::max(totals_.max_body_ratio, overlap / radius);
  totals_.collider_elastic.add(contact_energy(overlap, law));
  collider_loads_.add_contact(index, point, force);
}

void MeasurementSums::add_springs(std::uint64_t count, const ExactSum& energy) {
  totals_.springs += count;
  totals_.spring_energy.add(energy);
}

void MeasurementSums::add(const MeasurementSums& other) {
  totals_.box.add(other.totals_.box);
  totals_.particles += other.totals_.particles;
  totals_.contact_sides += other.totals_.contact_sides;
  totals_.wall_contacts += other.totals_.wall_contacts;
  totals_.springs += other.totals_.springs;
  totals_.mass.add(other.totals_.mass);
  totals_.kinetic.add(other.totals_.kinetic);
  totals_.potential.add(other.totals_.potential);
  totals_.elastic.add(other.totals_.elastic);
  totals_.wall_elastic.add(other.totals_.wall_elastic);
  totals_.overlap_ratio.add(other.totals_.overlap_ratio);
  totals_.momentum_scale.add(other.totals_.momentum_scale);
  totals_.momentum.add(other.totals_.momentum);
  totals_.mass_moment.add(other.totals_.mass_moment);
  totals_.wall_force.add(other.totals_.wall_force);
  totals_.collider_elastic.add(other.totals_.collider_elastic);
  totals_.spring_energy.add(other.totals_.spring_energy);
  totals_.attraction_energy.add(other.totals_.attraction_energy);
  collider_loads_.add(other.collider_loads_);
  totals_.max_speed = std::max(totals_.max_speed, other.totals_.max_speed);
  totals_.max_pair_ratio = std::max(totals_.max_pair_ratio, other.totals_.max_pair_ratio);
  totals_.max_body_ratio = std::max(totals_.max_body_ratio, other.totals_.max_body_ratio);
}

void MeasurementSums::write(std::vector<std::byte>& to) const {
  append_bytes(to, totals_);
  collider_loads_.write(to);
}

void MeasurementSums::add(std::span<const std::byte> from) {
  MeasurementSums other;
  take_bytes(from, other.totals_);
  other.collider_loads_.read(from);
  add(other);
}

Measurements MeasurementSums::result(std::size_t colliders) const {
  Measurements m;
  m.particles = totals_.particles;
  m.contacts = totals_.contact_sides / 2;
  m.wall_contacts = totals_.wall_contacts;
  m.kinetic_energy = totals_.kinetic.value();
  m.potential_energy = totals_.potential.value();
  m.elastic_energy = totals_.elastic.value();
  m.wall_elastic_energy = totals_.wall_elastic.value();
  m.momentum = totals_.momentum.value();
  if (totals_.particles > 0) m.centre_of_mass = (1 / totals_.mass.value()) * totals_.mass_moment.value();
  m.momentum_scale = totals_.momentum_scale.value();
  m.max_speed = totals_.max_speed;
  m.max_overlap_ratio = std::max(totals_.max_pair_ratio, totals_.max_body_ratio);
  m.max_pair_overlap_ratio = totals_.max_pair_ratio;
  if (totals_.contact_sides > 0)
    m.mean_overlap_ratio = totals_.overlap_ratio.value() / static_cast<double>(totals_.contact_sides);
  if (totals_.particles > 0) {
    m.min = totals_.box.min;
    m.max = totals_.box.max;
  }
  m.wall_force = totals_.wall_force.value();
  m.collider_elastic_energy = totals_.collider_elastic.value();
  m.springs = totals_.springs;
  m.spring_energy = totals_.spring_energy.value();
  m.attraction_energy = totals_.attraction_energy.value();
  m.colliders = collider_loads_.result(colliders);
  return m;
}

}  // namespace hooke
