// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "hooke/base/random.h"

namespace hooke::test {

/// Numbers whose sums are hard in different ways; the sum of some thousands is finite.
enum class Kind { alike, mixed, wild, cancelling, zero, tiny };

/// The i-th number of a kind.
template <class Real>
Real number(Kind kind, std::uint64_t i) {
  const auto u = uniform4(5, i, 0, static_cast<std::uint32_t>(kind));
  const int most = std::numeric_limits<Real>::max_exponent - 12;  // a sum of 4,096 of them stays finite
  const double sign = u[1] < 0.5 ? -1 : 1;
  switch (kind) {
    case Kind::alike:
      return static_cast<Real>(sign * (0.5 + 0.5 * u[0]));
    case Kind::mixed:
      return static_cast<Real>(std::ldexp(sign * (0.5 + 0.5 * u[0]), static_cast<int>(40 * u[2]) - 20));
    case Kind::wild:
      return static_cast<Real>(std::ldexp(sign * (0.5 + 0.5 * u[0]), static_cast<int>((2 * u[2] - 1) * most)));
    case Kind::cancelling:  // a large number, a small one, the large one again, negative
      return static_cast<Real>(i % 64 < 32 && i % 32 == 0 ? 1e30 : i % 32 == 0 ? -1e30 : u[0]);
    case Kind::zero:
      return static_cast<Real>(sign * 0.0);
    case Kind::tiny:
      return static_cast<Real>(sign * u[0]) * std::numeric_limits<Real>::min() / 8;  // without a leading 1
  }
  return {};
}

}  // namespace hooke::test
