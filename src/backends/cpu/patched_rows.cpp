// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/patched_rows.h"

#include <algorithm>
#include <utility>

#include "hooke/passes/force_pass.h"

namespace hooke {

void PatchedRows::clear(std::size_t slices) {
  for (const Patched& m : patched_) at_[m.slice] = kNone;
  patched_.clear();
  entries_.clear();
  if (at_.size() != slices) at_.assign(slices, kNone);
}

void PatchedRows::reserve(std::size_t slices) {
  patched_.reserve(slices);
  entries_.reserve(slices * 24 * kLanes);
}

// Inserts an entry in order of id index; the last entry of its lane is free.
template <class IdIndexOfEntry>
void PatchedRows::insert(const MissingEntry& missing, std::uint32_t* rows, std::size_t count, std::uint32_t filler,
                         const IdIndexOfEntry& id_index_of_entry) {
  std::size_t at = missing.of % kLanes;
  while (at < count && rows[at] != filler && id_index_of_entry(rows[at]) < missing.id_index) at += kLanes;
  for (std::uint32_t carried = missing.entry; at < count; at += kLanes) {
    std::swap(carried, rows[at]);
    if (carried == filler) break;
  }
}

template <class Real>
void PatchedRows::patch(std::vector<MissingEntry>& missing, const NeighbourList& list, std::uint32_t filler,
                        const std::uint32_t* id_indices) {
  const auto id_index_of_entry = [id_indices](std::uint32_t entry) {
    return id_indices[entry / record_offset<Real>(1)];
  };
  std::sort(missing.begin(), missing.end());
  missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
  for (std::size_t k = 0; k < missing.size();) {
    const std::size_t slice = missing[k].of / kLanes;
    std::size_t end = k, most = 0;  // of one lane
    for (std::size_t lane_start = k; end < missing.size() && missing[end].of / kLanes == slice; ++end) {
      if (missing[end].of != missing[lane_start].of) lane_start = end;
      most = std::max(most, end + 1 - lane_start);
    }
    const auto rows = list.rows(slice / NeighbourList::kSlices, slice % NeighbourList::kSlices);
    // Overwrites the filler after the previous rows.
    const std::size_t first = entries_.empty() ? 0 : entries_.size() - kBehind, count = rows.size() + most * kLanes;
    entries_.resize(first + count + kBehind, filler);
    std::copy(rows.begin(), rows.end(), entries_.begin() + static_cast<std::ptrdiff_t>(first));
    for (; k < end; ++k) insert(missing[k], entries_.data() + first, count, filler, id_index_of_entry);
    at_[slice] = static_cast<std::uint32_t>(patched_.size());
    patched_.push_back({slice, first, count});
  }
}

template void PatchedRows::patch<float>(std::vector<MissingEntry>& missing, const NeighbourList& list,
                                        std::uint32_t filler, const std::uint32_t* id_indices);
template void PatchedRows::patch<double>(std::vector<MissingEntry>& missing, const NeighbourList& list,
                                         std::uint32_t filler, const std::uint32_t* id_indices);

}  // namespace hooke
