// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/neighbours/window_order.h"

#include <algorithm>
#include <array>

#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"

namespace hooke {

namespace {
constexpr std::size_t kReadable = 16;  // places after the last
}

void WindowOrder::lay_out(std::span<std::uint32_t> order) {
  places_.resize(order.size() + kReadable);
  parallel_ranges(order.size(), 16 * kWindow, [&](std::size_t first, std::size_t last) {
    for (std::size_t start = first; start < last; start += kWindow) {
      sort_by_count(order.subspan(start, std::min(kWindow, last - start)), places_.data() + start);
    }
  });
  neighbour_counts_.resize(order.size());
}

void WindowOrder::add_in_order(std::size_t first, std::size_t end) {
  HOOKE_ASSERT(first % kWindow == 0 && first <= end, first, end);
  places_.resize(end + kReadable);
  for (std::size_t p = first; p < end; ++p) places_[p] = static_cast<std::uint8_t>(p % kWindow);
}

// Counting sort, stable.
void WindowOrder::sort_by_count(std::span<std::uint32_t> order, std::uint8_t* places) const {
  std::array<std::uint8_t, kWindow> count;
  std::uint8_t least = 255, most = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    count[k] = order[k] < neighbour_counts_.size() ? neighbour_counts_[order[k]] : std::uint8_t{0};
    least = std::min(least, count[k]);
    most = std::max(most, count[k]);
  }
  std::array<std::uint8_t, 257> first{};  // place of the first point with this many fewer neighbours than the most
  for (std::size_t k = 0; k < order.size(); ++k) ++first[most - count[k] + 1U];
  for (int fewer = 0; fewer < most - least; ++fewer) {
    first[static_cast<std::size_t>(fewer) + 1] =
        static_cast<std::uint8_t>(first[static_cast<std::size_t>(fewer)] + first[static_cast<std::size_t>(fewer) + 1]);
  }
  std::array<std::uint32_t, kWindow> before;
  std::copy(order.begin(), order.end(), before.begin());
  for (std::size_t k = 0; k < order.size(); ++k) {
    places[k] = first[static_cast<std::size_t>(most - count[k])]++;
    order[places[k]] = before[k];
  }
}

}  // namespace hooke
