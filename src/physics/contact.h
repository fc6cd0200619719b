// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

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

/// What one contact does to particle i, by cause, N; its partner receives the opposite. Sums of many contacts are kept
/// apart likewise, so that what each cause does to the energy can be told.
template <class R>
struct ContactForces {
  Vec3<R> spring{R(0), R(0), R(0)};
  Vec3<R> shear{R(0), R(0), R(0)};    ///< of the dashpot on the tangential part of the relative velocity
  Vec3<R> damping{R(0), R(0), R(0)};  ///< of the dashpot on the whole relative velocity

  HOOKE_HD Vec3<R> total() const { return (spring + shear) + damping; }
  HOOKE_HD ContactForces& operator+=(const ContactForces& other) {
    spring += other.spring;
    shear += other.shear;
    damping += other.damping;
    return *this;
  }
};

/// The vectors in which the law is linear. Contacts of the same coefficients can be summed in them, and the
/// coefficients applied to the sum: where a scene has one material, this is how its forces are defined.
template <class R>
struct ContactVectors {
  Vec3<R> overlap{R(0), R(0), R(0)};   ///< overlap n, m
  Vec3<R> normal{R(0), R(0), R(0)};    ///< (w . n) n, m/s
  Vec3<R> relative{R(0), R(0), R(0)};  ///< w, m/s

  HOOKE_HD ContactVectors& operator+=(const ContactVectors& other) {
    overlap += other.overlap;
    normal += other.normal;
    relative += other.relative;
    return *this;
  }
};

/// THE FORCE LAW (docs/theory.md eq. 1; the thesis's Algorithm 11): a spring along the normal, a
/// dashpot on the whole relative velocity and one on its tangential part.
///
///     F_i = k overlap n + c_s w_t + c_d w        w_t = w - (w . n) n
///
template <class R>
HOOKE_HD ContactForces<R> contact_forces(const ContactVectors<R>& contact, const ContactCoefficients<R>& c) {
  return {c.stiffness * contact.overlap, c.shear * (contact.relative - contact.normal), c.damping * contact.relative};
}

/// `overlap` (m) is r_i + r_p - d, positive when touching; `normal` the unit vector from the partner p
/// to i; `w` = v_p - v_i (m/s). Only to be applied where overlap > 0. Walls and colliders are partners
/// of infinite mass and use this same function.
template <class R>
HOOKE_HD ContactVectors<R> contact_vectors(const R& overlap, const Vec3<R>& normal, const Vec3<R>& w) {
  return {overlap * normal, dot(w, normal) * normal, w};
}
template <class R>
HOOKE_HD ContactForces<R> contact_forces(const R& overlap, const Vec3<R>& normal, const Vec3<R>& w,
                                         const ContactCoefficients<R>& c) {
  return contact_forces(contact_vectors(overlap, normal, w), c);
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

/// What surfaces may do beyond springs and dashpots. As they are set here they do nothing.
template <class R>
struct SurfaceCoefficients {
  R friction =
      R(std::numeric_limits<R>::infinity());  ///< mu, >= 0: no dashpot holds back more than mu times what presses
  R tension = R(std::numeric_limits<R>::infinity());  ///< N, >= 0: the most that damping pulls; 0: contacts only push
  R cohesion{};  ///< N, >= 0: pulls where surfaces touch
  R range{};  ///< m, >= 0: the gap at which cohesion ends

  /// Whether they do anything.
  bool act() const { return *this != SurfaceCoefficients{}; }
  friend bool operator==(const SurfaceCoefficients&, const SurfaceCoefficients&) = default;
};

/// All coefficients of one kind of contact.
template <class R>
struct ContactLaw {
  ContactCoefficients<R> linear;
  SurfaceCoefficients<R> surface;

  friend bool operator==(const ContactLaw&, const ContactLaw&) = default;
};

/// What one contact with surfaces does to particle i, N.
template <class R>
struct SurfaceForces {
  ContactForces<R> linear;  ///< cohesion is part of the spring; shear and damping of what doesn't slide
  Vec3<R> friction{R(0), R(0), R(0)};  ///< tangential, of what slides

  HOOKE_HD Vec3<R> total() const { return linear.total() + friction; }
  HOOKE_HD SurfaceForces& operator+=(const SurfaceForces& other) {
    linear += other.linear;
    friction += other.friction;
    return *this;
  }
};

/// THE FORCE LAW WITH SURFACES (docs/theory.md eq. 17). The dashpots' normal part pulls no harder than `tension`; where
/// the tangential part is more than mu max(0, k overlap + c_d w . n) the contact slides, and gets just that (Coulomb);
/// cohesion pulls by its full strength where overlap >= 0, and falls linearly to 0 at overlap = -range.
///
/// Only to be applied where overlap > -range. With coefficients that do nothing it is the law above, but for rounding.
template <class R>
HOOKE_HD SurfaceForces<R> contact_forces(const R& overlap, const Vec3<R>& normal, const Vec3<R>& w,
                                         const ContactLaw<R>& law) {
  const R none(0), one(1);
  const auto touching = overlap > none;
  const R approach = dot(w, normal);
  const Vec3<R> w_t = w - approach * normal;
  const R pushed = law.linear.stiffness * overlap, damped = law.linear.damping * approach;
  const R pressed = pushed + damped, lowest = none - law.surface.tension;
  const R kept = select(pressed < lowest, lowest - pushed, damped);

  const R tangential = law.linear.shear + law.linear.damping;
  const R held = tangential * sqrt_of(dot(w_t, w_t));
  const R limit = law.surface.friction * select(pressed > none, pressed, none);
  const auto slides = held > limit;  // never where nothing limits: infinity, or infinity times 0
  const R sliding = select(slides, tangential * (limit / select(slides, held, one)), none);
  const R shear = select(slides, none, law.linear.shear), damping = select(slides, none, law.linear.damping);

  const R nearness = select(touching, one, (law.surface.range + overlap) / law.surface.range);
  const R along = select(touching, pushed, none) - law.surface.cohesion * nearness;
  const auto where_touching = [&](const Vec3<R>& f) -> Vec3<R> {
    return {select(touching, f.x, none), select(touching, f.y, none), select(touching, f.z, none)};
  };
  return {{along * normal, where_touching(shear * w_t), where_touching(kept * normal + damping * w_t)},
          where_touching(sliding * w_t)};
}

/// The whole force, N, by the simpler law where surfaces do nothing.
inline Vec3<double> contact_force(double overlap, const Vec3<double>& normal, const Vec3<double>& w,
                                  const ContactLaw<double>& law) {
  return law.surface.act() ? contact_forces(overlap, normal, w, law).total()
                           : contact_forces(overlap, normal, w, law.linear).total();
}

/// Energy stored in the spring of a contact, J: k overlap^2 / 2.
template <class R>
HOOKE_HD R contact_energy(const R& overlap, const R& stiffness) {
  return R(0.5) * stiffness * overlap * overlap;
}

/// The same with what cohesion stores: 0 at overlap = -range, and below where it pulls.
inline double contact_energy(double overlap, const ContactLaw<double>& law) {
  const SurfaceCoefficients<double>& s = law.surface;
  if (overlap > 0) return contact_energy(overlap, law.linear.stiffness) - s.cohesion * (s.range / 2 + overlap);
  if (!(overlap > -s.range)) return 0;
  return -s.cohesion * (s.range + overlap) * (s.range + overlap) / (2 * s.range);
}

}  // namespace hooke
