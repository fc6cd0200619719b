// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/neighbours/neighbour_list.h"

namespace hooke {

/// Whether a lane of a slice's rows holds an entry.
inline bool is_in_lane(std::span<const std::uint32_t> rows, std::size_t lane, std::uint32_t entry) {
  for (std::size_t at = lane; at < rows.size(); at += NeighbourList::kLanes) {
    if (rows[at] == entry) return true;
  }
  return false;
}

/// Complete rows of the slices whose rows in the list lack a pair.
class PatchedRows {
  static constexpr std::size_t kLanes = NeighbourList::kLanes;

 public:
  /// One neighbour that particle `of` lacks.
  struct MissingEntry {
    std::uint32_t of, id_index, entry;  // the neighbour's id index and entry

    friend auto operator<=>(const MissingEntry&, const MissingEntry&) = default;
  };

  void clear(std::size_t slices);
  std::size_t count() const { return patched_.size(); }
  void reserve(std::size_t slices);
  bool holds(std::size_t slice) const { return at_[slice] != kNone; }
  /// The rows of a slice that it holds.
  std::span<const std::uint32_t> rows(std::size_t slice) const {
    HOOKE_ASSERT(holds(slice), slice);
    const Patched& m = patched_[at_[slice]];
    return std::span(entries_).subspan(m.first, m.count);
  }

  /// Copies the rows of the list that lack an entry, and adds the missing entries. Entries are offsets of records;
  /// `id_indices` are by record; `filler` stands for no entry.
  template <class Real>
  void patch(std::vector<MissingEntry>& missing, const NeighbourList& list, std::uint32_t filler,
             const std::uint32_t* id_indices);

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  static constexpr std::size_t kBehind = kRowsAhead * kLanes;
  struct Patched {
    std::size_t slice, first, count;  // its entries
  };

  template <class IdIndexOfEntry>
  static void insert(const MissingEntry& missing, std::uint32_t* rows, std::size_t count, std::uint32_t filler,
                     const IdIndexOfEntry& id_index_of_entry);

  std::vector<std::uint32_t> at_;  // by slice: index into patched_
  std::vector<Patched> patched_;
  std::vector<std::uint32_t> entries_;  // kRowsAhead rows of `filler` after the last
};

}  // namespace hooke
