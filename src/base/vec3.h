// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/base/real.h"

namespace hooke {

/// Three components of one quantity. R is float, double, or a pack of them; with a pack, a Vec3 holds
/// one vector per lane.
template <class R>
struct Vec3 {
  R x, y, z;

  HOOKE_HD Vec3& operator+=(const Vec3& b) {
    x = x + b.x;
    y = y + b.y;
    z = z + b.z;
    return *this;
  }
  HOOKE_HD Vec3& operator-=(const Vec3& b) {
    x = x - b.x;
    y = y - b.y;
    z = z - b.z;
    return *this;
  }
  friend HOOKE_HD Vec3 operator+(Vec3 a, const Vec3& b) { return a += b; }
  friend HOOKE_HD Vec3 operator-(Vec3 a, const Vec3& b) { return a -= b; }
  friend HOOKE_HD Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend HOOKE_HD Vec3 operator*(const R& s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend HOOKE_HD Vec3 operator*(const Vec3& a, const R& s) { return s * a; }
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;

/// a.x b.x + a.y b.y + a.z b.z, summed in that order.
template <class R>
HOOKE_HD R dot(const Vec3<R>& a, const Vec3<R>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Component `axis` (0, 1, 2 for x, y, z).
template <class R>
HOOKE_HD R& component(Vec3<R>& a, int axis) {
  return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}
template <class R>
HOOKE_HD const R& component(const Vec3<R>& a, int axis) {
  return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

/// Each component rounded to (or widened from) another number type.
template <class To, class From>
HOOKE_HD Vec3<To> vec_cast(const Vec3<From>& a) {
  return {static_cast<To>(a.x), static_cast<To>(a.y), static_cast<To>(a.z)};
}

}  // namespace hooke
