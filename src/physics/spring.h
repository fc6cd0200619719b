// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/base/vec3.h"

namespace hooke {

/// Whether a spring acts, by its mode `side`: 0 always, -1 while compressed, 1 while extended; never if NaN.
template <class R>
HOOKE_HD auto spring_acts(const R& extension, const R& side) {
  return side * extension >= R(0);
}

/// Whether a spring stretched by `extension` (m) beyond `rest_length` (m) is torn: its strain exceeds `break_strain`,
/// which is infinite for a spring that never tears.
template <class R>
HOOKE_HD auto spring_tears(const R& extension, const R& rest_length, const R& break_strain) {
  return extension > break_strain * rest_length;
}

/// The effect of a spring on particle i; its other end receives -force.
template <class R>
struct SpringForce {
  Vec3<R> force;  ///< on i, N
  R dissipation;  ///< power that the damper removes from the pair, W, >= 0
};

/// A spring between two particles with a damper along it (the thesis's eq. 4.1 and 4.2; docs/theory.md eq. 10).
///
///     F_i = (c w.n - k extension) n        extension = |x_i - x_p| - rest length
///
/// `normal` n is the unit vector from p to i, `w` = v_p - v_i (m/s), `stiffness` k in N/m, `damping` c in N s/m. To be
/// applied only where spring_acts().
template <class R>
HOOKE_HD SpringForce<R> spring_force(const R& extension, const Vec3<R>& normal, const Vec3<R>& w, const R& stiffness,
                                     const R& damping) {
  const R w_n = dot(w, normal);
  const R damped = damping * w_n;
  return {(damped - stiffness * extension) * normal, damped * w_n};
}

/// Energy stored in a spring that acts, J: k extension^2 / 2.
template <class R>
HOOKE_HD R spring_energy(const R& extension, const R& stiffness) {
  return R(0.5) * stiffness * extension * extension;
}

}  // namespace hooke
