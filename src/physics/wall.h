// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/base/vec3.h"

namespace hooke {

// A wall is the face of the domain across one axis: a partner of infinite mass that does not move. Its contact goes
// through contact_force() like any other, with the overlap below and w = -v_i (docs/theory.md eq. 3).

/// r - (x - min): overlap (m) with the face at the lower end of an axis, for a centre at `x` and radius `r`.
template <class R>
HOOKE_HD R lower_wall_overlap(const R& x, const R& min, const R& radius) {
  return radius - (x - min);
}

/// r - (max - x): the same at the upper end.
template <class R>
HOOKE_HD R upper_wall_overlap(const R& x, const R& max, const R& radius) {
  return radius - (max - x);
}

/// Unit vector along `axis` (0, 1, 2) times `sign`: +1 from a lower face into the domain, -1 from an upper one.
template <class R>
HOOKE_HD Vec3<R> wall_normal(int axis, const R& sign) {
  return {axis == 0 ? sign : R(0), axis == 1 ? sign : R(0), axis == 2 ? sign : R(0)};
}

}  // namespace hooke
