// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/base/vec3.h"

namespace hooke {

/// Coefficients of one kind of contact.
template <class R>
struct ContactCoefficients {
  R stiffness{};  ///< k, N/m, >= 0
  R shear{};      ///< c_s, N s/m, >= 0: dashpot on the tangential part of the relative velocity
  R damping{};    ///< c_d, N s/m, >= 0: dashpot on the whole relative velocity

  friend bool operator==(const ContactCoefficients&, const ContactCoefficients&) = default;
};

/// What one contact does to particle i; its partner receives -force.
template <class R>
struct ContactForce {
  Vec3<R> force;   ///< on i, N
  R dissipation;   ///< power that both dashpots take out of the pair, W, >= 0
};

/// THE FORCE LAW (docs/theory.md eq. 1; the thesis's Algorithm 11): a spring along the normal, a
/// dashpot on the whole relative velocity and one on its tangential part.
///
///     F_i = k overlap n + c_s w_t + c_d w        w_t = w - (w . n) n
///
/// and, sorted by direction, F_i = (k overlap - c_s w.n) n + (c_s + c_d) w, which is how it is computed.
///
/// `overlap` (m) is r_i + r_p - d, positive when touching; `normal` the unit vector from the partner p
/// to i; `w` = v_p - v_i (m/s). Only to be applied where overlap > 0. Walls and colliders are partners
/// of infinite mass and use this same function.
template <class R>
HOOKE_HD ContactForce<R> contact_force(const R& overlap, const Vec3<R>& normal, const Vec3<R>& w,
                                       const ContactCoefficients<R>& c) {
  const R w_n = dot(w, normal);
  const R both = c.shear + c.damping;
  const R shear_n = c.shear * w_n;
  return {(c.stiffness * overlap - shear_n) * normal + both * w, both * dot(w, w) - shear_n * w_n};
}

/// Unit vector from p to i, where `x_ip` = x_i - x_p (m) has length `distance`. Two centres on the very
/// same spot have no direction: there it is `tie` along x, +1 for the particle of the higher id and -1
/// for the other, so that the pair still pushes apart by equal and opposite forces.
template <class R>
HOOKE_HD Vec3<R> contact_normal(const Vec3<R>& x_ip, const R& distance, const R& tie) {
  const auto coincident = distance == R(0);
  const R inverse = R(1) / select(coincident, R(1), distance);
  return {select(coincident, tie, x_ip.x * inverse), x_ip.y * inverse, x_ip.z * inverse};
}

/// The same where no two centres coincide: `distance` > 0, else not a number.
template <class R>
HOOKE_HD Vec3<R> contact_normal(const Vec3<R>& x_ip, const R& distance) {
  return (R(1) / distance) * x_ip;
}

/// Energy stored in the spring of a contact, J: k overlap^2 / 2.
template <class R>
HOOKE_HD R contact_energy(const R& overlap, const R& stiffness) {
  return R(0.5) * stiffness * overlap * overlap;
}

}  // namespace hooke
