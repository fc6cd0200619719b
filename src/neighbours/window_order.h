// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hooke/neighbours/window_search.h"

namespace hooke {

/// The slot in memory of each point in cell order. Within a window, points with the most neighbours in the last list
/// come first, so that the lanes of a slice have similar lengths and few entries of a list are padding (the sorting
/// scope of SELL-C-sigma: Kreutzer et al., "A unified sparse matrix data format", SIAM J. Sci. Comput. 2014).
class WindowOrder {
 public:
  /// On input, order[p] is the previous slot of the p-th point in cell order; on output, order[s] is the previous slot
  /// of the point now in slot s. A point without a known number of neighbours counts as having none.
  void lay_out(std::span<std::uint32_t> order);

  /// Points `first`, a whole window, to `end` - 1 lie in memory in their order; those before that were not laid out are
  /// not to be asked for. After lay_out().
  void add_in_order(std::size_t first, std::size_t end);

  /// The slot of the p-th point in cell order, for points that were laid out.
  std::size_t slot_of(std::size_t p) const { return p / kWindow * kWindow + places_[p]; }
  /// The slot within its window of each point in cell order; 16 more can be read.
  const std::uint8_t* places() const { return places_.data(); }
  /// By slot, written by a search: a point's number of neighbours with itself, up to 255.
  std::uint8_t* neighbour_counts() { return neighbour_counts_.data(); }

 private:
  void sort_by_count(std::span<std::uint32_t> order, std::uint8_t* places) const;

  std::vector<std::uint8_t> places_, neighbour_counts_;
};

}  // namespace hooke
