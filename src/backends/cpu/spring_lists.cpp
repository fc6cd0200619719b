// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/spring_lists.h"
#include "hooke/base/assert.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "hooke/base/parallel.h"

namespace hooke {

template <class Real>
void SpringLists<Real>::configure(const Scene& scene, const RulesView<Real>& rules, SpringPassFunction<Real> run) {
  run_ = run;
  pass_.length = rules.length;
  pass_.any_periodic = false;
  for (int axis = 0; axis < 3; ++axis) {
    pass_.periodic[axis] = rules.periodic[axis];
    pass_.any_periodic = pass_.any_periodic || rules.periodic[axis];
  }
  table_.configure(scene.structure, rules.period);
}

template <class Real>
void SpringLists<Real>::lay_out(const Record* records, std::size_t count, std::size_t size,
                                const std::vector<std::uint32_t>& slot_of) {
  HOOKE_ASSERT(count < size, count, size);
  const std::size_t slices = (count + kLanes - 1) / kLanes;
  const std::vector<std::uint32_t>& first_side = table_.first_side();
  count_ = count;
  first_row_.resize(slices + 1);
  force_.resize(size);
  parallel_ranges(slices, kSlices, [&](std::size_t first, std::size_t last) {
    for (std::size_t g = first; g < last; ++g) {
      std::uint32_t most = 0;
      for (std::size_t i = g * kLanes; i < std::min(count, (g + 1) * kLanes); ++i) {
        const std::uint32_t id_index = id_index_of(records[i].id_index);
        if (!is_vacant(records[i])) most = std::max(most, first_side[id_index + 1] - first_side[id_index]);
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
        const std::uint32_t from = here ? first_side[id_index] : 0, to = here ? first_side[id_index + 1] : 0;
        for (std::uint32_t r = first_row_[g]; r < first_row_[g + 1]; ++r) {
          SpringRow<Real>& row = rows_[r];
          const std::uint32_t k = from + (r - first_row_[g]);
          const SpringSide side = k < to ? table_.sides()[k] : SpringSide{};
          const bool ties = k < to && !table_.is_broken(side.spring) && slot_of[side.partner] != kVacant;
          row.partner[lane] = ties ? record_offset<Real>(slot_of[side.partner]) : filler;
          row.kind[lane] = ties ? table_.kind()[side.spring] : kNoSpring;
          row.rest_length[lane] = ties ? table_.rest_length()[side.spring] : Real(1);
        }
      }
    }
  });
}

template <class Real>
const std::vector<std::pair<std::uint32_t, std::uint32_t>>& SpringLists<Real>::apply(const Record* records,
                                                                                     bool may_tear, SpringSums& sums) {
  pass_.records = records;
  pass_.kinds = table_.kinds().data();
  pass_.force = force_.data();
  pass_.may_tear = may_tear && table_.is_tearable();
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
  parallel_ranges(table_.first_side().size() - 1, kTile, [&](std::size_t first, std::size_t last) {
    ExactSum part;
    std::uint64_t count = 0;
    for (std::size_t id_index = first; id_index < last; ++id_index) {
      for_each_side(records, slot_of, id_index, [&](const SpringSide& side, std::size_t i, std::size_t p) {
        if (side.partner < id_index || i >= count_) return;
        ++count;
        part.add(table_.energy_of(side.spring, records[i], records[p]));
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
  for_each_side(records, slot_of, id_index, [&](const SpringSide& side, std::size_t i, std::size_t p) {
    const bool both = std::binary_search(among.begin(), among.end(), p);
    sum.add((both ? 0.5 : 1.0) * table_.energy_of(side.spring, records[i], records[p]));
  });
}

// Removes the springs that tore from a slice's rows. Each of a spring's two ends does so; the lower one counts it.
// Where that is a ghost, another rank does.
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
      const SpringSide& side = table_.sides()[table_.first_side()[id_index] + (r - first_row_[g])];
      if (side.partner < id_index && partner < count_) continue;
      if (side.partner > id_index) {
        ++sums.broken;
        sums.broken_energy.add(table_.energy_of(side.spring, own, other));
      }
      const std::lock_guard lock(mutex_);
      torn_.push_back(side.spring);
      if (table_.tear(side.spring, id_index, side.partner))
        released_.emplace_back(static_cast<std::uint32_t>(g * kLanes + lane), partner);
    }
  }
}

// visit(side, i, p) for each spring of an id index that still holds, between records i and p.
template <class Real>
template <class Visit>
void SpringLists<Real>::for_each_side(const Record* records, const std::vector<std::uint32_t>& slot_of,
                                      std::size_t id_index, const Visit& visit) const {
  const std::uint32_t i = slot_of[id_index];
  if (i == kVacant || is_vacant(records[i])) return;
  table_.for_each_side(id_index, [&](const SpringSide& side) {
    const std::uint32_t p = slot_of[side.partner];
    if (p != kVacant && !is_vacant(records[p])) visit(side, i, p);
  });
}

template class SpringLists<float>;
template class SpringLists<double>;

}  // namespace hooke
