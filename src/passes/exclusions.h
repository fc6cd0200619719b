// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "hooke/base/assert.h"

namespace hooke {

/// Pairs of particles, by id index, that don't touch each other because a spring keeps them apart.
class Exclusions {
 public:
  Exclusions() = default;
  /// `id_indices` is above all id indices of the pairs; each pair counts both ways.
  Exclusions(std::size_t id_indices, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
    if (pairs.empty()) return;
    first_.assign(id_indices + 1, 0);
    for (const auto& [a, b] : pairs) {
      HOOKE_ASSERT(a < id_indices && b < id_indices, a, b, id_indices);
      ++first_[a + 1];
      ++first_[b + 1];
    }
    for (std::size_t id_index = 0; id_index < id_indices; ++id_index) first_[id_index + 1] += first_[id_index];
    partners_.resize(2 * pairs.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (const auto& [a, b] : pairs) {
      partners_[next[a]++] = b;
      partners_[next[b]++] = a;
    }
  }

  bool empty() const { return partners_.empty(); }
  /// Partners first()[r] and on, to first()[r + 1], are of id index r; all bits 1 where a pair may touch.
  const std::vector<std::uint32_t>& first() const { return first_; }
  const std::vector<std::uint32_t>& partners() const { return partners_; }
  /// There are more particles now; the new ones have no pairs.
  void grow(std::size_t id_indices) {
    if (!empty()) first_.resize(id_indices + 1, first_.back());
  }

  bool hold(std::uint32_t a, std::uint32_t b) const {
    return !empty() && std::find(begin(a), begin(a + 1), b) != begin(a + 1);
  }

  /// From now on, these two may touch.
  void release(std::uint32_t a, std::uint32_t b) {
    HOOKE_ASSERT(hold(a, b) && hold(b, a), a, b);
    *std::find(begin(a), begin(a + 1), b) = kNobody;
    *std::find(begin(b), begin(b + 1), a) = kNobody;
  }

  /// Removes the partners of this id index's particle from the particle's row of a neighbour list, whose `count`
  /// entries are `stride` apart; `filler` stands for no entry.
  template <class IdIndexOfEntry>
  void strike(std::uint32_t id_index, std::uint32_t* row, std::size_t count, std::size_t stride, std::uint32_t filler,
              const IdIndexOfEntry& id_index_of_entry) const {
    std::uint64_t some = 0;  // bit (partner mod 64) is set for each partner
    for (auto p = begin(id_index); p != begin(id_index + 1); ++p) some |= std::uint64_t{1} << (*p & 63U);
    if (some == 0) return;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < count && row[k * stride] != filler; ++k) {
      const std::uint32_t entry = row[k * stride], other = id_index_of_entry(entry);
      if ((some >> (other & 63U) & 1U) != 0 && hold(id_index, other)) continue;
      row[kept++ * stride] = entry;
    }
    for (; kept < count && row[kept * stride] != filler; ++kept) row[kept * stride] = filler;
  }

 private:
  static constexpr std::uint32_t kNobody = ~std::uint32_t{0};

  std::vector<std::uint32_t>::const_iterator begin(std::uint32_t id_index) const {
    return partners_.begin() + first_[id_index];
  }
  std::vector<std::uint32_t>::iterator begin(std::uint32_t id_index) { return partners_.begin() + first_[id_index]; }

  std::vector<std::uint32_t> first_, partners_;  // of id index r: partners_[first_[r]] to partners_[first_[r + 1] - 1]
};

}  // namespace hooke
