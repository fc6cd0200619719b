// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/spring_lists.h"
#include "hooke/base/ascending.h"
#include "hooke/base/assert.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <map>
#include <tuple>

#include "hooke/base/parallel.h"
#include "hooke/physics/periodic.h"
#include "hooke/physics/spring.h"

namespace hooke {

template <class Real>
void SpringLists<Real>::configure(const Scene& scene, const RulesView<Real>& rules, SpringPassFunction<Real> run) {
  run_ = run;
  pass_.length = rules.length;
  period_ = rules.period;
  pass_.any_periodic = false;
  for (int axis = 0; axis < 3; ++axis) {
    pass_.periodic[axis] = rules.periodic[axis];
    pass_.any_periodic = pass_.any_periodic || rules.periodic[axis];
  }
  if (scene.structure != structure_) take(scene.structure);
  break_springs({});
}

template <class Real>
void SpringLists<Real>::break_springs(const std::vector<std::uint64_t>& broken) {
  HOOKE_ASSERT(is_ascending(broken), broken.size());
  HOOKE_ASSERT(broken.empty() || broken.back() < kind_.size(), broken.back(), kind_.size());
  broken_.assign(kind_.size(), 0);
  for (const std::uint64_t s : broken) broken_[s] = 1;
}

template <class Real>
std::vector<std::uint64_t> SpringLists<Real>::broken() const {
  std::vector<std::uint64_t> all;
  for (std::size_t s = 0; s < broken_.size(); ++s) {
    if (broken_[s] != 0) all.push_back(s);
  }
  return all;
}

template <class Real>
void SpringLists<Real>::bind(const IdTable& ids) {
  if (empty()) return;
  const SpringSet& springs = structure_->springs;
  first_side_.assign(ids.size() + 1, 0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> apart;
  const auto each = [&](const auto& visit) {
    for (std::size_t s = 0; s < springs.size(); ++s) {
      const std::size_t a = ids.find(springs.a[s]), b = ids.find(springs.b[s]);
      if (a < ids.size() && b < ids.size()) {
        visit(static_cast<std::uint32_t>(s), static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
      }
    }
  };
  each([&](std::uint32_t s, std::uint32_t a, std::uint32_t b) {
    ++first_side_[a + 1];
    ++first_side_[b + 1];
    if (springs.contact[s] == 0 && broken_[s] == 0) apart.emplace_back(a, b);
  });
  for (std::size_t id_index = 0; id_index < ids.size(); ++id_index) first_side_[id_index + 1] += first_side_[id_index];
  sides_.resize(first_side_.back());
  std::vector<std::uint32_t> next(first_side_.begin(), first_side_.end() - 1);
  each([&](std::uint32_t s, std::uint32_t a, std::uint32_t b) {
    sides_[next[a]++] = {s, b};
    sides_[next[b]++] = {s, a};
  });
  exclusions_ = Exclusions(ids.size(), apart);
}

template <class Real>
void SpringLists<Real>::grow(std::size_t id_indices) {
  if (empty()) return;
  HOOKE_ASSERT(id_indices + 1 >= first_side_.size(), id_indices, first_side_.size());
  first_side_.resize(id_indices + 1, first_side_.back());
  exclusions_.grow(id_indices);
}

template <class Real>
void SpringLists<Real>::lay_out(const Record* records, std::size_t count, std::size_t size,
                                const std::vector<std::uint32_t>& slot_of) {
  HOOKE_ASSERT(count < size, count, size);
  const std::size_t slices = (count + kLanes - 1) / kLanes;
  count_ = count;
  first_row_.resize(slices + 1);
  force_.resize(size);
  parallel_ranges(slices, kSlices, [&](std::size_t first, std::size_t last) {
    for (std::size_t g = first; g < last; ++g) {
      std::uint32_t most = 0;
      for (std::size_t i = g * kLanes; i < std::min(count, (g + 1) * kLanes); ++i) {
        const std::uint32_t id_index = id_index_of(records[i].id_index);
        if (!is_vacant(records[i])) most = std::max(most, first_side_[id_index + 1] - first_side_[id_index]);
      }
      first_row_[g + 1] = most;
    }
  });
  first_row_[0] = 0;
  for (std::size_t g = 0; g < slices; ++g) first_row_[g + 1] += first_row_[g];
  rows_.resize(first_row_.back());
  const auto filler = record_offset<Real>(static_cast<std::uint32_t>(size - 1));
  parallel_ranges(slices, kSlices, [&](std::size_t first, std::size_t last) {
    for (std::size_t g = first; g < last; ++g) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::size_t i = g * kLanes + lane;
        const bool here = i < count && !is_vacant(records[i]);
        const std::uint32_t id_index = here ? id_index_of(records[i].id_index) : 0;
        const std::uint32_t from = here ? first_side_[id_index] : 0, to = here ? first_side_[id_index + 1] : 0;
        for (std::uint32_t r = first_row_[g]; r < first_row_[g + 1]; ++r) {
          SpringRow<Real>& row = rows_[r];
          const std::uint32_t k = from + (r - first_row_[g]);
          const bool ties = k < to && broken_[sides_[k].spring] == 0 && slot_of[sides_[k].partner] != kVacant;
          row.partner[lane] = ties ? record_offset<Real>(slot_of[sides_[k].partner]) : filler;
          row.kind[lane] = ties ? kind_[sides_[k].spring] : kNoSpring;
          row.rest_length[lane] = ties ? rest_length_[sides_[k].spring] : Real(1);
        }
      }
    }
  });
}

template <class Real>
const std::vector<std::pair<std::uint32_t, std::uint32_t>>& SpringLists<Real>::apply(const Record* records,
                                                                                     bool may_tear, SpringSums& sums) {
  pass_.records = records;
  pass_.kinds = kinds_.data();
  pass_.force = force_.data();
  pass_.may_tear = may_tear && tearable_;
  released_.clear();
  parallel_ranges(count_, kTile, [&](std::size_t first, std::size_t last) {
    SpringSums part;
    for (std::size_t at = first; at < last; at += kTile) {
      std::array<Real, kTile> power;
      std::array<unsigned char, kSlices> torn{};
      SpringWork<Real> work;
      work.first = at;
      work.slice_count = (std::min(kTile, last - at) + kLanes - 1) / kLanes;
      work.rows = rows_.data();
      work.first_row = first_row_.data() + at / kLanes;
      work.power = power.data();
      work.torn = torn.data();
      run_(pass_, work);
      part.dissipation.add(power.data(), std::min(kTile, last - at));
      for (std::size_t g = 0; g < work.slice_count; ++g) {
        if (torn[g] != 0) finish_torn(records, at / kLanes + g, part);
      }
    }
    const std::lock_guard lock(mutex_);
    sums.add(part);
  });
  return released_;
}

template <class Real>
void SpringLists<Real>::measure(const Record* records, const std::vector<std::uint32_t>& slot_of,
                                MeasurementSums& sums) const {
  if (empty()) return;
  ExactSum energy;
  std::atomic<std::uint64_t> holding{0};
  parallel_ranges(first_side_.size() - 1, kTile, [&](std::size_t first, std::size_t last) {
    ExactSum part;
    std::uint64_t count = 0;
    for (std::size_t id_index = first; id_index < last; ++id_index) {
      for_each_side(records, slot_of, id_index, [&](const Side& side, std::size_t i, std::size_t p) {
        if (side.partner < id_index) return;
        ++count;
        part.add(energy_of(side.spring, records[i], records[p]));
      });
    }
    holding += count;
    const std::lock_guard lock(mutex_);
    energy.add(part);
  });
  sums.add_springs(holding, energy);
}

template <class Real>
void SpringLists<Real>::add_energy(const Record* records, const std::vector<std::uint32_t>& slot_of,
                                   std::size_t id_index, std::span<const std::uint32_t> among, ExactSum& sum) const {
  if (empty()) return;
  for_each_side(records, slot_of, id_index, [&](const Side& side, std::size_t i, std::size_t p) {
    const bool both = std::binary_search(among.begin(), among.end(), p);
    sum.add((both ? 0.5 : 1.0) * energy_of(side.spring, records[i], records[p]));
  });
}

template <class Real>
void SpringLists<Real>::take(const std::shared_ptr<const Structure>& structure) {
  structure_ = structure;
  constexpr Real kInfinite = std::numeric_limits<Real>::infinity(), kNever = std::numeric_limits<Real>::quiet_NaN();
  kinds_.assign(kFirstSpringKind, {Real(0), Real(0), kInfinite, kNever});
  kind_.clear();
  rest_length_.clear();
  sides_.clear();
  first_side_.clear();
  exclusions_ = {};
  tearable_ = false;
  if (!structure) return;
  const SpringSet& springs = structure->springs;
  std::map<std::tuple<double, double, double, SpringMode>, std::uint32_t> known;
  kind_.reserve(springs.size());
  rest_length_.reserve(springs.size());
  for (std::size_t s = 0; s < springs.size(); ++s) {
    const auto [kind, is_new] =
        known.try_emplace({springs.stiffness[s], springs.damping[s], springs.break_strain[s], springs.mode[s]},
                          static_cast<std::uint32_t>(kinds_.size()));
    if (is_new) {
      const SpringMode mode = springs.mode[s];
      kinds_.push_back({static_cast<Real>(springs.stiffness[s]), static_cast<Real>(springs.damping[s]),
                        static_cast<Real>(springs.break_strain[s]),
                        Real(mode == SpringMode::compression ? -1
                             : mode == SpringMode::extension ? 1
                                                             : 0)});
      tearable_ = tearable_ || kinds_.back().break_strain < kInfinite;
    }
    kind_.push_back(kind->second);
    rest_length_.push_back(static_cast<Real>(springs.rest_length[s]));
  }
}

// Removes the springs that tore from a slice's rows. Each of a spring's two ends does so; the lower one counts it.
template <class Real>
void SpringLists<Real>::finish_torn(const Record* records, std::size_t g, SpringSums& sums) {
  for (std::uint32_t r = first_row_[g]; r < first_row_[g + 1]; ++r) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (rows_[r].kind[lane] != kTornSpring) continue;
      rows_[r].kind[lane] = kNoSpring;
      const Record& own = records[g * kLanes + lane];
      const std::uint32_t partner = rows_[r].partner[lane] / record_offset<Real>(1);
      const Record& other = records[partner];
      const std::uint32_t id_index = id_index_of(own.id_index);
      const Side& side = sides_[first_side_[id_index] + (r - first_row_[g])];
      if (side.partner < id_index) continue;
      broken_[side.spring] = 1;
      ++sums.broken;
      sums.broken_energy.add(energy_of(side.spring, own, other));
      if (structure_->springs.contact[side.spring] == 0) {
        const std::lock_guard lock(mutex_);
        exclusions_.release(id_index, side.partner);
        released_.emplace_back(static_cast<std::uint32_t>(g * kLanes + lane), partner);
      }
    }
  }
}

template <class Real>
double SpringLists<Real>::energy_of(std::uint32_t spring, const Record& i, const Record& p) const {
  const SpringKind<Real>& kind = kinds_[kind_[spring]];
  const Vec3<Real> x_ip = nearest_displacement(i.x, p.x, period_);
  const Real extension = sqrt_of(dot(x_ip, x_ip)) - rest_length_[spring];
  return spring_acts(extension, kind.side) ? static_cast<double>(spring_energy(extension, kind.stiffness)) : 0.0;
}

// visit(side, i, p) for each spring of an id index that still holds, between records i and p.
template <class Real>
template <class Visit>
void SpringLists<Real>::for_each_side(const Record* records, const std::vector<std::uint32_t>& slot_of,
                                      std::size_t id_index, const Visit& visit) const {
  const std::uint32_t i = slot_of[id_index];
  if (i == kVacant || is_vacant(records[i])) return;
  for (std::uint32_t k = first_side_[id_index]; k < first_side_[id_index + 1]; ++k) {
    const Side& side = sides_[k];
    const std::uint32_t p = slot_of[side.partner];
    if (broken_[side.spring] == 0 && p != kVacant && !is_vacant(records[p])) visit(side, i, p);
  }
}

template class SpringLists<float>;
template class SpringLists<double>;

}  // namespace hooke
