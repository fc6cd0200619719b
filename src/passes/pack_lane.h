// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

// The pack of one lane: what a thread of a GPU computes with, and the instruction set "scalar" of the CPU back end,
// which shows on any processor what a GPU computes. It has all that packs have (backends/cpu/pack.h and its
// companions), for host and device. Included by a file that defines HOOKE_ISA as the name of its namespace.

#include <cstddef>
#include <cstdint>

#include "hooke/base/real.h"
#include "hooke/base/vec3.h"
#include "hooke/physics/attraction.h"

namespace hooke::HOOKE_ISA {

/// How many rows of neighbours a force pass has under way at once. A GPU hides what they wait for by other threads, and
/// each row takes registers.
inline constexpr std::size_t kRowsAtOnce = 2;

/// One number that is asked for by its lane, a number of any type, as the lanes of a register are.
template <class T>
struct OneLane {
  T number;
  template <class Lane>
  HOOKE_HD T& operator[](Lane) {
    return number;
  }
  template <class Lane>
  HOOKE_HD const T& operator[](Lane) const {
    return number;
  }
};

template <class Real>
struct Mask {
  using Bits = bool;
  bool v;

  friend HOOKE_HD Mask operator&(const Mask& a, const Mask& b) { return {a.v && b.v}; }
  friend HOOKE_HD Mask operator|(const Mask& a, const Mask& b) { return {a.v || b.v}; }
  friend HOOKE_HD Mask operator!(const Mask& a) { return {!a.v}; }
};

template <class Real>
struct Pack {
  static constexpr std::size_t kLanes = 1;
  using Vector = OneLane<Real>;
  Vector v;

  Pack() = default;
  HOOKE_HD Pack(Real s) : v{s} {}  // NOLINT: a number stands for a pack of it, as in the laws
  HOOKE_HD explicit Pack(Vector vector) : v(vector) {}

  friend HOOKE_HD Pack operator+(const Pack& a, const Pack& b) { return a.v.number + b.v.number; }
  friend HOOKE_HD Pack operator-(const Pack& a, const Pack& b) { return a.v.number - b.v.number; }
  friend HOOKE_HD Pack operator*(const Pack& a, const Pack& b) { return a.v.number * b.v.number; }
  friend HOOKE_HD Pack operator/(const Pack& a, const Pack& b) { return a.v.number / b.v.number; }
  friend HOOKE_HD Pack operator-(const Pack& a) { return -a.v.number; }
  friend HOOKE_HD Mask<Real> operator<(const Pack& a, const Pack& b) { return {a.v.number < b.v.number}; }
  friend HOOKE_HD Mask<Real> operator>(const Pack& a, const Pack& b) { return {a.v.number > b.v.number}; }
  friend HOOKE_HD Mask<Real> operator<=(const Pack& a, const Pack& b) { return {a.v.number <= b.v.number}; }
  friend HOOKE_HD Mask<Real> operator>=(const Pack& a, const Pack& b) { return {a.v.number >= b.v.number}; }
  friend HOOKE_HD Mask<Real> operator==(const Pack& a, const Pack& b) { return {a.v.number == b.v.number}; }
};

template <class Real>
HOOKE_HD Pack<Real> select(const Mask<Real>& m, const Pack<Real>& a, const Pack<Real>& b) {
  return m.v ? a : b;
}
/// a + b where m holds, else a.
template <class Real>
HOOKE_HD Pack<Real> add_where(const Mask<Real>& m, const Pack<Real>& a, const Pack<Real>& b) {
  return m.v ? a + b : a;
}
/// a where m holds, else 0.
template <class Real>
HOOKE_HD Pack<Real> only_where(const Mask<Real>& m, const Pack<Real>& a) {
  return m.v ? a : Pack<Real>(Real(0));
}
template <class Real>
HOOKE_HD Pack<Real> sqrt_of(const Pack<Real>& a) {
  return hooke::sqrt_of(a.v.number);
}
HOOKE_HD Pack<float> magnitude(const Pack<float>& a) { return __builtin_fabsf(a.v.number); }
HOOKE_HD Pack<double> magnitude(const Pack<double>& a) { return __builtin_fabs(a.v.number); }

template <class Real>
HOOKE_HD unsigned bits(const Mask<Real>& m) {
  return m.v ? 1U : 0U;
}
template <class Real>
HOOKE_HD Mask<Real> lanes_of(unsigned set) {
  return {(set & 1U) != 0};
}
template <class Real>
HOOKE_HD bool any(const Mask<Real>& m) {
  return m.v;
}

HOOKE_HD void prefetch(const void*) {}

template <class Real>
HOOKE_HD Pack<Real> load(const Real* from) {
  return *from;
}
template <class Real>
HOOKE_HD void store(Real* to, const Pack<Real>& a) {
  *to = a.v.number;
}

// Records and tables ------------------------------------------------------------------------------------------------

template <class Real>
struct Quad {
  Pack<Real> a, b, c, d;
};
template <class Real>
struct TwoQuads {
  Quad<Real> first, second;
};

/// Four numbers as a GPU moves them: at most 16 bytes at once.
template <class Real>
struct alignas(16) FourNumbers {
  Real a, b, c, d;
};

template <class Real, class At>
HOOKE_HD Quad<Real> load_quads(Real, const At& at) {
  const FourNumbers<Real> q = *reinterpret_cast<const FourNumbers<Real>*>(at(0));
  return {q.a, q.b, q.c, q.d};
}
template <class Real, class At>
HOOKE_HD TwoQuads<Real> load_two_quads(Real, const At& at) {
  return {load_quads(Real{}, at), load_quads(Real{}, [&](int lane) { return at(lane) + 4; })};
}
template <class Real, class At>
HOOKE_HD void store_two_quads(const TwoQuads<Real>& q, const At& at) {
  auto* const to = reinterpret_cast<FourNumbers<Real>*>(at(0));
  to[0] = {q.first.a.v.number, q.first.b.v.number, q.first.c.v.number, q.first.d.v.number};
  to[1] = {q.second.a.v.number, q.second.b.v.number, q.second.c.v.number, q.second.d.v.number};
}
template <class Real>
HOOKE_HD Vec3<Pack<Real>> load_vectors(const Vec3<Real>* from) {
  return {from->x, from->y, from->z};
}

template <class Real>
struct SmallTable {
  const Real* entries;
  HOOKE_HD explicit SmallTable(const Real* from) : entries(from) {}
  HOOKE_HD Pack<Real> lookup(const Pack<Real>& index) const {
    return entries[static_cast<std::size_t>(index.v.number)];
  }
};

// Attraction --------------------------------------------------------------------------------------------------------

template <class Real>
HOOKE_HD Pack<Real> inverse_root(const Pack<Real>& a) {
  return hooke::inverse_root(a.v.number);
}

/// The laws' arithmetic where bits may differ between machines. This one differs from ExactMath by its operations'
/// order alone.
struct FastMath {
  template <class Real>
  HOOKE_HD static Pack<Real> multiply_add(const Pack<Real>& a, const Pack<Real>& b, const Pack<Real>& c) {
    return a * b + c;
  }
  HOOKE_HD static Pack<float> inverse_root_of(const Pack<float>& a) {
    const float seed = inverse_root_first(a.v.number), y = inverse_root_next(a.v.number, seed);
    return y * ((-0.5F * a.v.number) * (y * y) + 1.5F);
  }
  HOOKE_HD static Pack<double> inverse_root_of(const Pack<double>& a) {
    const double seed = inverse_root_first(a.v.number);
    return inverse_root_next(a.v.number, inverse_root_next(a.v.number, seed));
  }
};

}  // namespace hooke::HOOKE_ISA
