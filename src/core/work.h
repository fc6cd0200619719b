// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "hooke/base/assert.h"
#include "hooke/core/cause.h"

namespace hooke {

/// One T for each of the first `kCount` causes.
template <class T, std::size_t kCount = kCauses>
struct ByCause {
  std::array<T, kCount> of{};

  T& operator[](Cause cause) {
    HOOKE_ASSERT(static_cast<std::size_t>(cause) < kCount, cause, kCount);
    return of[static_cast<std::size_t>(cause)];
  }
  const T& operator[](Cause cause) const {
    HOOKE_ASSERT(static_cast<std::size_t>(cause) < kCount, cause, kCount);
    return of[static_cast<std::size_t>(cause)];
  }

  friend bool operator==(const ByCause&, const ByCause&) = default;
};

/// Work, J, or power, W, by cause: positive where it adds to the kinetic energy. The work of a force over a step is the
/// force times the step times the mean of the velocities before and after, so that the sum over all causes is what the
/// kinetic energy gains, but for rounding (docs/theory.md eq. 13).
using Work = ByCause<double>;

}  // namespace hooke
