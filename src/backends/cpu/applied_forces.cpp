// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/applied_forces.h"

#include <array>

#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"

namespace hooke {

template <class Real>
void AppliedForces<Real>::configure(const Scene& scene, const ForcePass<Real>& rules, const Loops<Real>& loops) {
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
  work_pass_ = loops.work_pass;
}

template <class Real>
void AppliedForces<Real>::bind(const IdTable& ids, const Records& records, std::size_t count) {
  springs_.bind(ids);
  fields_.bind(ids);
  held_ranks_.clear();
  held_ = {};
  std::vector<std::uint32_t>& held = held_ranks_;
  if (structure_) {
    for (const std::uint64_t id : structure_->held) {
      const std::size_t rank = ids.find(id);
      if (rank < ids.size()) held.push_back(static_cast<std::uint32_t>(rank));
    }
  }
  for (std::size_t i = 0; any_fixed_ && i < count; ++i) {
    const Record& p = records[i];
    if (!is_vacant(p) && fixed_[static_cast<std::size_t>(p.material)]) {
      held.push_back(static_cast<std::uint32_t>(rank_of(p.rank)));
    }
  }
  if (!held.empty()) find_places(records, count, ids.size());
  if (!held.empty()) find_held(count);
}

template <class Real>
void AppliedForces<Real>::add(std::size_t slot, std::size_t ranks, bool fixed, std::size_t room) {
  if (needs_layout()) {
    place_.resize(ranks, SpringLists<Real>::kVacant);
    place_.back() = static_cast<std::uint32_t>(slot);
  }
  springs_.grow(ranks);
  fields_.grow(ranks);
  if (!fixed) return held_.release(slot);
  if (held_.none()) held_.clear(room);
  held_.hold(slot);
  held_ranks_.push_back(static_cast<std::uint32_t>(ranks - 1));
}

template <class Real>
void AppliedForces<Real>::lay_out(const Records& records, std::size_t count, std::size_t ranks) {
  find_places(records, count, ranks);
  if (!springs_.empty()) springs_.lay_out(records.data(), count, records.size(), place_);
  if (!held_.none()) find_held(count);
}

template <class Real>
const typename AppliedForces<Real>::Pairs& AppliedForces<Real>::apply(const Records& records, std::size_t count,
                                                                      std::size_t alive, const IdTable& ids,
                                                                      bool may_tear, SpringSums& sums) {
  static const Pairs kNone;
  const Pairs* released = &kNone;
  acting_.clear();
  if (!springs_.empty()) {
    released = &springs_.apply(records.data(), may_tear, sums);
    acting_.push_back({Cause::springs, springs_.forces()});
  }
  if (!fields_.empty()) {
    fields_.apply(records, count, place_);
    acting_.push_back({Cause::field, fields_.forces()});
  }
  if (!attraction_.empty()) {
    attraction_.apply(records, count, alive, ids);
    acting_.push_back({Cause::attraction, attraction_.forces()});
  }
  if (acting_.size() > 1) {
    total_.resize(records.size());
    parallel_ranges(count, kTile, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        total_[i] = acting_[0].force[i];
        for (std::size_t k = 1; k < acting_.size(); ++k) total_[i] += acting_[k].force[i];
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
  for (const Acting& acting : acting_) add_work(acting, first, last, before, after, acceleration, sums);
}

template <class Real>
void AppliedForces<Real>::measure(const Records& records, std::size_t count, std::size_t alive, const IdTable& ids,
                                  Measurements& m) {
  springs_.measure(records.data(), place_, m);
  if (!attraction_.empty()) m.attraction_energy = attraction_.energy(records, count, alive, ids);
}

template <class Real>
void AppliedForces<Real>::find_places(const Records& records, std::size_t count, std::size_t ranks) {
  place_.assign(ranks, SpringLists<Real>::kVacant);
  parallel_ranges(count, kTile, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (!is_vacant(records[i])) place_[rank_of(records[i].rank)] = static_cast<std::uint32_t>(i);
    }
  });
}

template <class Real>
void AppliedForces<Real>::find_held(std::size_t count) {
  held_.clear(count);
  for (const std::uint32_t rank : held_ranks_) {
    if (place_[rank] != SpringLists<Real>::kVacant) held_.hold(place_[rank]);
  }
}

template <class Real>
void AppliedForces<Real>::hold_still(std::size_t first, std::size_t last, const Record* before, Record* after,
                                     Vec3<Real>* acceleration, AppliedSums& sums) const {
  if (held_.none()) return;
  for (std::size_t i = first; i < last; ++i) {
    if (!held_.holds(i) || is_vacant(before[i])) continue;
    sums.add_held(mass_[static_cast<std::size_t>(before[i].material)], vec_cast<double>(before[i].v),
                  vec_cast<double>(after[i].v), kick_);
    after[i] = before[i];
    if (acceleration != nullptr) acceleration[i] = {Real(0), Real(0), Real(0)};
  }
}

template <class Real>
void AppliedForces<Real>::add_work(const Acting& acting, std::size_t first, std::size_t last, const Record* before,
                                   const Record* after, const Vec3<Real>* acceleration, AppliedSums& sums) const {
  const bool external = acting.cause != Cause::springs;  // they give each other what they take
  std::array<ExactParts, WorkSum::count> parts;
  for (ExactParts& part : parts) part.count = 0;
  work_pass_(
      {before + first, after + first, acting.force + first, acceleration == nullptr ? nullptr : acceleration + first,
       static_cast<Real>(kick_), last - first, external},
      parts.data());
  AppliedSums::Rates& rates = sums[acting.cause];
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
