// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "hooke/neighbours/layout.h"

namespace hooke {

/// A few numbers with the same exact sum as many numbers.
struct ExactParts {
  static constexpr std::size_t kMost = kTile;
  std::size_t count;
  double values[kMost];
};

}  // namespace hooke
