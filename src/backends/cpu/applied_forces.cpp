// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/applied_forces.h"

#include <algorithm>
#include <array>

#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"

namespace hooke {

template <class Real>
void AppliedForces<Real>::configure(const Scene& scene, const RulesView<Real>& rules, const Loops<Real>& loops) {
  structure_ = scene.structure;
  kick_ = scene.integrator == Integrator::velocity_verlet ? scene.time_step / 2 : scene.time_step;
  mass_.clear();
  fixed_.clear();
  any_fixed_ = false;
  for (const Material& m : scene.materials) {
    mass_.push_back(m.mass);
    fixed_.push_back(m.fixed);
    any_fixed_ = any_fixed_ || m.fixed;
  }
  springs_.configure(scene, rules, loops.spring_pass);
  fields_.configure(scene);
  attraction_.configure(scene, loops.attraction);
  external_.clear();
  applied_.clear();
  work_pass_ = loops.work_pass;
}

template <class Real>
void AppliedForces<Real>::bind(const Particles& particles) {
  const IdTable& ids = particles.ids;
  springs_.bind(ids);
  fields_.bind(ids);
  bind_pinned(particles);
}

template <class Real>
void AppliedForces<Real>::bind_pinned(const Particles& particles) {
  const IdTable& ids = particles.ids;
  pinned_id_indices_.clear();
  pinned_ = {};
  std::vector<std::uint32_t>& pinned = pinned_id_indices_;
  if (structure_) {
    for (const std::uint64_t id : structure_->pinned) {
      const std::size_t id_index = ids.find(id);
      if (id_index < ids.size()) pinned.push_back(static_cast<std::uint32_t>(id_index));
    }
  }
  for (std::size_t i = 0; any_fixed_ && i < particles.slots.end(); ++i) {
    const Record& p = particles.records[i];
    if (!is_vacant(p) && fixed_[static_cast<std::size_t>(p.material)]) {
      pinned.push_back(static_cast<std::uint32_t>(id_index_of(p.id_index)));
    }
  }
  if (pinned.empty()) return;
  particles.find_slots();
  find_pinned(particles);
}

template <class Real>
void AppliedForces<Real>::add(const Particles& particles, std::size_t slot, bool fixed) {
  const std::size_t id_indices = particles.ids.size();
  grow(id_indices);
  if (!fixed) return pinned_.release(slot);
  if (pinned_.none()) pinned_.clear(particles.slots.room());
  pinned_.hold(slot);
  pinned_id_indices_.push_back(static_cast<std::uint32_t>(id_indices - 1));
}

template <class Real>
void AppliedForces<Real>::lay_out(const Particles& particles) {
  particles.find_known_slots();
  const auto& records = particles.records;
  if (!springs_.empty()) {
    springs_.lay_out(records.data(), particles.slots.room(), records.size(), particles.known_slots_by_id_index());
  }
  if (!pinned_.none()) find_pinned(particles);
}

template <class Real>
const typename AppliedForces<Real>::Pairs& AppliedForces<Real>::apply(const Particles& particles, bool may_tear,
                                                                      SpringSums& sums) {
  const auto& records = particles.records;
  const std::size_t count = particles.slots.end();
  static const Pairs kNone;
  const Pairs* released = &kNone;
  applied_.clear();
  if (!springs_.empty()) {
    released = &springs_.apply(records.data(), may_tear, sums);
    applied_.push_back({Cause::springs, springs_.forces()});
  }
  if (!fields_.empty()) {
    if (fields_.needs_places()) particles.find_known_slots();
    fields_.apply(records, count, particles.known_slots_by_id_index());
    applied_.push_back({Cause::field, fields_.forces()});
  }
  if (!attraction_.empty()) {
    attraction_.apply(records, particles.slots, particles.count(), particles.ids);
    applied_.push_back({Cause::attraction, attraction_.forces()});
  }
  if (!external_.empty()) applied_.push_back({Cause::external, external_.column(particles)});
  if (applied_.size() > 1) {
    total_.resize(records.size());
    parallel_ranges(count, kTile, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        total_[i] = applied_[0].force[i];
        for (std::size_t k = 1; k < applied_.size(); ++k) total_[i] += applied_[k].force[i];
      }
    });
  }
  return *released;
}

template <class Real>
void AppliedForces<Real>::finish(std::size_t first, std::size_t last, const Record* before, Record* after,
                                 Vec3<Real>* acceleration, AppliedSums& sums) const {
  HOOKE_ASSERT(last - first <= kTile, first, last);
  hold_still(first, last, before, after, acceleration, sums);
  for (const AppliedForce& applied : applied_) add_work(applied, first, last, before, after, acceleration, sums);
}

template <class Real>
void AppliedForces<Real>::measure(const Particles& particles, MeasurementSums& sums) {
  springs_.measure(particles.records.data(), particles.known_slots_by_id_index(), sums);
  if (attraction_.empty()) return;
  sums.add_attraction(attraction_.energy(particles.records, particles.slots, particles.count(), particles.ids));
}

template <class Real>
void AppliedForces<Real>::want_partners(const Particles& particles, std::vector<std::uint32_t>& id_indices) const {
  if (springs_.empty() && !fields_.needs_places()) return;
  particles.find_slots();
  const std::vector<std::uint32_t>& slot_of = particles.slots_by_id_index();
  const auto want = [&](std::uint32_t id_index) {
    if (slot_of[id_index] == Particles::kNoSlot) id_indices.push_back(id_index);
  };
  for (std::size_t i = 0; i < particles.slots.end(); ++i) {
    if (is_vacant(particles.records[i])) continue;
    const std::uint32_t own = id_index_of(particles.records[i].id_index);
    springs_.for_each_partner(own, want);
    fields_.for_each_corner(own, want);
  }
  std::sort(id_indices.begin(), id_indices.end());
  id_indices.erase(std::unique(id_indices.begin(), id_indices.end()), id_indices.end());
}

template <class Real>
void AppliedForces<Real>::find_pinned(const Particles& particles) {
  pinned_.clear(particles.slots.room());
  for (const std::uint32_t id_index : pinned_id_indices_) {
    const std::uint32_t slot = particles.slots_by_id_index()[id_index];
    if (slot != Particles::kNoSlot) pinned_.hold(slot);
  }
}

template <class Real>
void AppliedForces<Real>::hold_still(std::size_t first, std::size_t last, const Record* before, Record* after,
                                     Vec3<Real>* acceleration, AppliedSums& sums) const {
  if (pinned_.none()) return;
  for (std::size_t i = first; i < last; ++i) {
    if (!pinned_.holds(i) || is_vacant(before[i])) continue;
    sums.add_pinned(mass_[static_cast<std::size_t>(before[i].material)], vec_cast<double>(before[i].v),
                    vec_cast<double>(after[i].v), kick_);
    after[i] = before[i];
    if (acceleration != nullptr) acceleration[i] = {Real(0), Real(0), Real(0)};
  }
}

template <class Real>
void AppliedForces<Real>::add_work(const AppliedForce& applied, std::size_t first, std::size_t last,
                                   const Record* before, const Record* after, const Vec3<Real>* acceleration,
                                   AppliedSums& sums) const {
  const bool has_resultant = applied.cause != Cause::springs;  // spring forces sum to 0
  std::array<ExactParts, WorkSum::count> parts;
  for (ExactParts& part : parts) part.count = 0;
  work_pass_(
      {before + first, after + first, applied.force + first, acceleration == nullptr ? nullptr : acceleration + first,
       static_cast<Real>(kick_), last - first, has_resultant},
      parts.data());
  AppliedSums::Rates& rates = sums[applied.cause];
  const auto add = [&](int sum, ExactSum& to) {
    const ExactParts& part = parts[static_cast<std::size_t>(sum)];
    to.add(part.values, part.count);
  };
  add(WorkSum::power, rates.power);
  add(WorkSum::next_power, rates.next_power);
  for (int axis = 0; axis < 3; ++axis) add(WorkSum::force + axis, rates.force[axis]);
}

template class AppliedForces<float>;
template class AppliedForces<double>;

}  // namespace hooke
