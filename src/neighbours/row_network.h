// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "hooke/base/real.h"

namespace hooke {

/// Calls exchange(a, b) for the pairs of rows that Batcher's merge exchange compares, in its order (Knuth, The Art of
/// Computer Programming, 5.2.2, algorithm M).
template <class Exchange>
HOOKE_HD constexpr void merge_exchange(std::size_t rows, const Exchange& exchange) {
  std::size_t top = 1;
  while (2 * top < rows) top *= 2;
  for (std::size_t p = top; p > 0; p /= 2) {
    std::size_t q = top, r = 0, d = p;
    for (;;) {
      for (std::size_t row = 0; row + d < rows; ++row) {
        if ((row & p) == r) exchange(row, row + d);
      }
      if (q == p) break;
      d = q - p;
      q /= 2;
      r = p;
    }
  }
}

/// The same pairs as a table, for rows that registers hold, whose numbers must be known when the sort is compiled.
template <std::size_t kRows>
struct RowNetwork {
  struct Pair {
    unsigned char a, b;
  };
  HOOKE_HD static constexpr std::size_t count() {
    std::size_t n = 0;
    merge_exchange(kRows, [&](std::size_t, std::size_t) { ++n; });
    return n;
  }
  struct Pairs {
    Pair of[count() + 1];
  };
  HOOKE_HD static constexpr Pairs pairs() {
    Pairs all{};
    std::size_t n = 0;
    merge_exchange(kRows, [&](std::size_t a, std::size_t b) {
      all.of[n++] = {static_cast<unsigned char>(a), static_cast<unsigned char>(b)};
    });
    return all;
  }
};

}  // namespace hooke
