// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "hooke/base/assert.h"
#include "hooke/base/real.h"

namespace hooke {

struct SineCosine {
  double sine = 0, cosine = 1;
};

/// Sine and cosine of an angle in turns (1 is 360 degrees), with the same bits on every machine; mathematical libraries
/// differ between machines, and so would their results. Plain arithmetic; off by at most 2e-16 for any angle that a
/// double can tell apart (up to 2^52 turns), and exact at quarters of a turn. The angle must be finite.
HOOKE_HD SineCosine sine_cosine_of_turns(double turns) {
  HOOKE_ASSERT(std::isfinite(turns), turns);
  // Quarter turns are subtracted without rounding, which leaves at most an eighth of a turn either way.
  const double quarters = std::floor(4 * turns + 0.5);
  constexpr double kTwoPi = 6.283185307179586477;
  const double a = kTwoPi * (turns - 0.25 * quarters);
  // Taylor series; the first omitted terms are below 1e-19 for |a| <= pi/4.
  const double a2 = a * a;
  double sine = -1 / 121645100408832000.0;  // 19!
  double cosine = -1 / 6402373705728000.0;  // 18!
  constexpr double kSineTerms[] = {1 / 355687428096000.0, -1 / 1307674368000.0, 1 / 6227020800.0, -1 / 39916800.0,
                                   1 / 362880.0,          -1 / 5040.0,          1 / 120.0,        -1 / 6.0};
  constexpr double kCosineTerms[] = {1 / 20922789888000.0, -1 / 87178291200.0, 1 / 479001600.0, -1 / 3628800.0,
                                     1 / 40320.0,          -1 / 720.0,         1 / 24.0,        -1 / 2.0};
  for (const double term : kSineTerms) sine = sine * a2 + term;
  for (const double term : kCosineTerms) cosine = cosine * a2 + term;
  sine = a + a * (a2 * sine);
  cosine = 1 + a2 * cosine;
  switch (static_cast<int>(quarters - 4 * std::floor(0.25 * quarters))) {
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    case 3:
      return {-cosine, sine};
    default:
      return {sine, cosine};
  }
}

}  // namespace hooke
