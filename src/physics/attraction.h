// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/base/vec3.h"

namespace hooke {

// 1 / sqrt(a) from additions and multiplications alone, for a > 0 well inside the range of its type: the same bits
// everywhere, and in packs four times as fast as a square root and a division. Halving the bits of `a` and subtracting
// them from a constant gives an estimate that is nowhere more than some percent off. Kadlec's constants (2010) reduce
// the error of the first step to 6.5e-4, and each further step cubes the error (Householder). Single precision needs
// one further step, double precision two.

HOOKE_HD float inverse_root_seed(float a) {
  return __builtin_bit_cast(float, 0x5F1FFFF9U - (__builtin_bit_cast(unsigned, a) >> 1U));
}
HOOKE_HD double inverse_root_seed(double a) {
  return __builtin_bit_cast(double, 0x5FE3FFFF20000000ULL - (__builtin_bit_cast(unsigned long long, a) >> 1U));
}

template <class R>
HOOKE_HD R inverse_root_first(const R& a) {
  const R y = inverse_root_seed(a);
  return (R(0.703952253F) * y) * (R(2.38924456F) - a * (y * y));
}
template <class R>
HOOKE_HD R inverse_root_next(const R& a, const R& y) {
  const R off = R(1) - a * (y * y);
  return y + (y * off) * (R(0.5F) + R(0.375F) * off);
}

HOOKE_HD float inverse_root(float a) { return inverse_root_next(a, inverse_root_first(a)); }
HOOKE_HD double inverse_root(double a) { return inverse_root_next(a, inverse_root_next(a, inverse_root_first(a))); }

/// The arithmetic of the laws in this file: each operation is rounded once. Packs have another one, which is faster but
/// whose bits are not the same everywhere.
struct ExactMath {
  template <class R>
  HOOKE_HD static R multiply_add(const R& a, const R& b, const R& c) {
    return a * b + c;
  }
  template <class R>
  HOOKE_HD static R inverse_root_of(const R& a) {
    return inverse_root(a);
  }
};

/// d^2 + eps^2 of the vector `towards` (m) from one centre to the other, on which attraction depends. `softening2` is
/// eps^2, m^2, > 0 (core/attraction.h).
template <class Math, class R>
HOOKE_HD R softened_square(const Vec3<R>& towards, const R& softening2) {
  return Math::multiply_add(
      towards.z, towards.z,
      Math::multiply_add(towards.y, towards.y, Math::multiply_add(towards.x, towards.x, softening2)));
}

/// THE LAW OF ATTRACTION (docs/theory.md eq. 11; the thesis's eq. 4.5, softened by Plummer's length eps): the
/// acceleration towards a particle of mass `mass` (kg) of a particle at -`towards` (m) from it:
///
///     a = G mass towards / (d^2 + eps^2)^(3/2)
///
/// Returns the factor of `towards`, without G. Two centres at the very same place do not attract each other.
template <class Math, class R>
HOOKE_HD R attraction(const Vec3<R>& towards, const R& mass, const R& softening2) {
  const R inverse = Math::inverse_root_of(softened_square<Math>(towards, softening2));
  return (mass * inverse) * (inverse * inverse);
}

/// Potential of the same particle there, without G: -mass / sqrt(d^2 + eps^2), kg/m.
template <class Math, class R>
HOOKE_HD R attraction_potential(const Vec3<R>& towards, const R& mass, const R& softening2) {
  return -(mass * Math::inverse_root_of(softened_square<Math>(towards, softening2)));
}

/// Many particles seen from afar: their mass at its centre, and its spread around the centre.
template <class R>
struct MassCloud {
  R mass;  ///< kg
  R xx, xy, xz, yy, yz, zz;  ///< 3 sum m r r^T around the centre of mass, kg m^2
  R trace;  ///< 1.5 sum m r.r, kg m^2
};

/// Acceleration by a cloud of mass, up to the quadrupole: eq. 12, the derivative of the expansion of eq. 11 in 1 / d.
/// `towards` (m) leads to the centre of mass. Without G.
template <class Math, class R>
HOOKE_HD Vec3<R> cloud_attraction(const Vec3<R>& towards, const MassCloud<R>& cloud, const R& softening2) {
  const auto madd = [](const R& a, const R& b, const R& c) { return Math::multiply_add(a, b, c); };
  const R inverse = Math::inverse_root_of(softened_square<Math>(towards, softening2));
  const R inverse2 = inverse * inverse;
  const Vec3<R> u = inverse * towards;
  const Vec3<R> w{madd(cloud.xz, u.z, madd(cloud.xy, u.y, cloud.xx * u.x)),
                  madd(cloud.yz, u.z, madd(cloud.yy, u.y, cloud.xy * u.x)),
                  madd(cloud.zz, u.z, madd(cloud.yz, u.y, cloud.xz * u.x))};
  const R along = madd(u.z, w.z, madd(u.y, w.y, u.x * w.x));
  const R radial = inverse2 * madd(inverse2, madd(R(2.5F), along, -cloud.trace), cloud.mass);
  const R across = -(inverse2 * inverse2);
  return {madd(across, w.x, radial * u.x), madd(across, w.y, radial * u.y), madd(across, w.z, radial * u.z)};
}

/// Potential of a cloud of mass, up to the quadrupole, without G, kg/m.
template <class Math, class R>
HOOKE_HD R cloud_potential(const Vec3<R>& towards, const MassCloud<R>& cloud, const R& softening2) {
  const R inverse = Math::inverse_root_of(softened_square<Math>(towards, softening2));
  const Vec3<R> u = inverse * towards;
  const Vec3<R> w{cloud.xx * u.x + cloud.xy * u.y + cloud.xz * u.z, cloud.xy * u.x + cloud.yy * u.y + cloud.yz * u.z,
                  cloud.xz * u.x + cloud.yz * u.y + cloud.zz * u.z};
  constexpr float kThird = 1.0F / 3.0F;
  const R spread = R(0.5F) * dot(u, w) - R(kThird) * cloud.trace;
  return -(inverse * (cloud.mass + (inverse * inverse) * spread));
}

}  // namespace hooke
