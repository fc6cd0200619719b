// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/base/vec3.h"

namespace hooke {

/// Components along a periodic axis of length L (m). A displacement between particles is
/// (x_i - x_p) - s L with a whole number s, the periodic image of p (docs/theory.md eq. 5).
template <class R>
HOOKE_HD R image_displacement(const R& x_i, const R& x_p, const R& s, const R& length) {
  return (x_i - x_p) - s * length;
}

/// The s in {-1, 0, 1} that brings p's image nearest to i, for x_i and x_p inside the domain. Where
/// the axis is at least two contact distances long, no other image can touch.
template <class R>
HOOKE_HD R nearest_image(const R& x_i, const R& x_p, const R& length) {
  const R half = R(0.5) * length;
  const R d = x_i - x_p;
  return select(d > half, R(1), select(d < -half, R(-1), R(0)));
}

/// `x` (m) brought back into [min, max) after a drift across a periodic face. A particle that moved by several
/// lengths of the axis in one step comes back too. The result is always inside, also where the subtraction rounds to
/// max or, after very many lengths, misses the domain: then it is min. NaN, and what is a billion lengths away, stay as
/// they are: the step reports them.
template <class R>
HOOKE_HD R wrap_coordinate(R x, R min, R max) {
  if (x >= min && x < max) return x;
  const R length = max - min;
  const R turns = (x - min) / length;
  if (!(turns > R(-1e9) && turns < R(1e9))) return x;
  auto whole = static_cast<long long>(turns);
  if (turns < R(0)) --whole;
  x = x - static_cast<R>(whole) * length;
  if (x < min) x = x + length;
  return x >= min && x < max ? x : min;
}

}  // namespace hooke
