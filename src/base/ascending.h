// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <functional>
#include <iterator>

namespace hooke {

/// Whether each element is greater than the one before.
template <class Range>
bool is_ascending(const Range& range) {
  return std::adjacent_find(std::begin(range), std::end(range), std::greater_equal<>()) == std::end(range);
}

}  // namespace hooke
