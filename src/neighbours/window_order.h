// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hooke/base/parallel.h"
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
  void lay_out(std::span<std::uint32_t> order) {
    constexpr std::size_t kReadable = 16;
    places_.resize(order.size() + kReadable);
    parallel_ranges(order.size(), 16 * kWindow, [&](std::size_t first, std::size_t last) {
      for (std::size_t start = first; start < last; start += kWindow) {
        sort_by_count(order.subspan(start, std::min(kWindow, last - start)), places_.data() + start);
      }
    });
    neighbour_counts_.resize(order.size());
  }

  /// The slot of the p-th point in cell order, of those laid out.
  std::size_t slot_of(std::size_t p) const { return p / kWindow * kWindow + places_[p]; }
  /// Which slot of its window each point in cell order lies in; 16 more can be read.
  const std::uint8_t* places() const { return places_.data(); }
  /// By slot, for a search to write: how many neighbours a point has, up to 255.
  std::uint8_t* neighbour_counts() { return neighbour_counts_.data(); }

 private:
  // Counting sort, stable.
  void sort_by_count(std::span<std::uint32_t> order, std::uint8_t* places) const {
    std::array<std::uint8_t, kWindow> count;
    std::uint8_t least = 255, most = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
      count[k] = order[k] < neighbour_counts_.size() ? neighbour_counts_[order[k]] : std::uint8_t{0};
      least = std::min(least, count[k]);
      most = std::max(most, count[k]);
    }
    std::array<std::uint8_t, 257> first{};  // place of the first point that has so many fewer than the most
    for (std::size_t k = 0; k < order.size(); ++k) ++first[most - count[k] + 1U];
    for (int fewer = 0; fewer < most - least; ++fewer) {
      first[static_cast<std::size_t>(fewer) + 1] = static_cast<std::uint8_t>(
          first[static_cast<std::size_t>(fewer)] + first[static_cast<std::size_t>(fewer) + 1]);
    }
    std::array<std::uint32_t, kWindow> before;
    std::copy(order.begin(), order.end(), before.begin());
    for (std::size_t k = 0; k < order.size(); ++k) {
      places[k] = first[static_cast<std::size_t>(most - count[k])]++;
      order[places[k]] = before[k];
    }
  }

  std::vector<std::uint8_t> places_, neighbour_counts_;
};

}  // namespace hooke
