// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/mended_rows.h"

#include <algorithm>
#include <utility>

#include "hooke/backends/cpu/force_pass.h"

namespace hooke {

void MendedRows::clear(std::size_t groups) {
  for (const Mended& m : mended_) at_[m.group] = kNone;
  mended_.clear();
  entries_.clear();
  if (at_.size() != groups) at_.assign(groups, kNone);
}

void MendedRows::reserve(std::size_t groups) {
  mended_.reserve(groups);
  entries_.reserve(groups * 24 * kLanes);
}

// Puts one in its place by rank; the last entry of its lane is free.
template <class RankOfEntry>
void MendedRows::insert(const Lack& lack, std::uint32_t* rows, std::size_t count, std::uint32_t filler,
                        const RankOfEntry& rank_of_entry) {
  std::size_t at = lack.of % kLanes;
  while (at < count && rows[at] != filler && rank_of_entry(rows[at]) < lack.rank) at += kLanes;
  for (std::uint32_t carried = lack.entry; at < count; at += kLanes) {
    std::swap(carried, rows[at]);
    if (carried == filler) break;
  }
}

template <class Real>
void MendedRows::mend(std::vector<Lack>& lacks, const NeighbourList& list, std::uint32_t filler,
                      const std::uint32_t* ranks) {
  const auto rank_of_entry = [ranks](std::uint32_t entry) { return ranks[entry / record_offset<Real>(1)]; };
  std::sort(lacks.begin(), lacks.end());
  lacks.erase(std::unique(lacks.begin(), lacks.end()), lacks.end());
  for (std::size_t k = 0; k < lacks.size();) {
    const std::size_t group = lacks[k].of / kLanes;
    std::size_t end = k, most = 0;  // of one lane
    for (std::size_t lane_start = k; end < lacks.size() && lacks[end].of / kLanes == group; ++end) {
      if (lacks[end].of != lacks[lane_start].of) lane_start = end;
      most = std::max(most, end + 1 - lane_start);
    }
    const auto rows = list.rows(group / NeighbourList::kGroups, group % NeighbourList::kGroups);
    // Over what is behind the rows before.
    const std::size_t first = entries_.empty() ? 0 : entries_.size() - kBehind, count = rows.size() + most * kLanes;
    entries_.resize(first + count + kBehind, filler);
    std::copy(rows.begin(), rows.end(), entries_.begin() + static_cast<std::ptrdiff_t>(first));
    for (; k < end; ++k) insert(lacks[k], entries_.data() + first, count, filler, rank_of_entry);
    at_[group] = static_cast<std::uint32_t>(mended_.size());
    mended_.push_back({group, first, count});
  }
}

template void MendedRows::mend<float>(std::vector<Lack>& lacks, const NeighbourList& list, std::uint32_t filler,
                                      const std::uint32_t* ranks);
template void MendedRows::mend<double>(std::vector<Lack>& lacks, const NeighbourList& list, std::uint32_t filler,
                                       const std::uint32_t* ranks);

}  // namespace hooke
