// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hooke/neighbours/window_search.h"

namespace hooke {

/// Which slot in memory each of the points in cell order lies in. Within a window those come first that had the most
/// neighbours when they were listed last: so the lanes of a group are about equally long, and few entries of a list
/// only fill up short ones (the sorting scope of SELL-C-sigma: Kreutzer et al., "A unified sparse matrix data format",
/// SIAM J. Sci. Comput. 2014).
class WindowOrder {
 public:
  /// `order` says of each point in cell order in which slot it lay before; afterwards, of each slot, in which slot its
  /// point did. Points of no known number of neighbours count as having none.
  void lay_out(std::span<std::uint32_t> order);

  /// The slot of the p-th point in cell order, of those laid out.
  std::size_t slot_of(std::size_t p) const { return p / kWindow * kWindow + places_[p]; }
  /// Which slot of its window each point in cell order lies in; 16 more can be read.
  const std::uint8_t* places() const { return places_.data(); }
  /// By slot, for a search to write: how many neighbours a point has, up to 255.
  std::uint8_t* neighbour_counts() { return neighbour_counts_.data(); }

 private:
  void sort_by_count(std::span<std::uint32_t> order, std::uint8_t* places) const;

  std::vector<std::uint8_t> places_, neighbour_counts_;
};

}  // namespace hooke
