// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

// SIMD packs: this file and the other pack_*.h files contain the intrinsics of AVX2 and AVX-512. Without these, packs
// are the vectors of 16 bytes that GCC and Clang offer on every processor. Included by a file that is compiled for one
// instruction set and defines HOOKE_ISA as the name of its namespace.
// Everything is always inlined, so that no function built for a newer processor can be the copy that the linker keeps.

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#include <cstddef>
#include <cstdint>

#include "hooke/base/real.h"

namespace hooke::HOOKE_ISA {

/// How many rows of neighbours a force pass has under way at once.
inline constexpr std::size_t kRowsAtOnce = 8;

#if defined(__AVX512F__)
inline constexpr std::size_t kPackBytes = 64;
#elif defined(__AVX2__)
inline constexpr std::size_t kPackBytes = 32;
#else
inline constexpr std::size_t kPackBytes = 16;
#endif

// The registers behind packs and masks (compilers take the attribute on concrete types only).
typedef float FloatVector __attribute__((vector_size(kPackBytes)));
typedef double DoubleVector __attribute__((vector_size(kPackBytes)));
typedef std::int32_t Int32Vector __attribute__((vector_size(kPackBytes)));
typedef std::int64_t Int64Vector __attribute__((vector_size(kPackBytes)));

template <class Real>
struct Registers;
template <>
struct Registers<float> {
  using Numbers = FloatVector;
#if defined(__AVX512F__)
  using Truths = __mmask16;
#else
  using Truths = Int32Vector;
#endif
};
template <>
struct Registers<double> {
  using Numbers = DoubleVector;
#if defined(__AVX512F__)
  using Truths = __mmask8;
#else
  using Truths = Int64Vector;
#endif
};

/// One truth value per lane: one bit, or all bits of the lane.
template <class Real>
struct Mask {
  using Bits = typename Registers<Real>::Truths;
  Bits v;

  friend HOOKE_HD Mask operator&(const Mask& a, const Mask& b) { return {static_cast<Bits>(a.v & b.v)}; }
  friend HOOKE_HD Mask operator|(const Mask& a, const Mask& b) { return {static_cast<Bits>(a.v | b.v)}; }
  friend HOOKE_HD Mask operator!(const Mask& a) { return {static_cast<Bits>(~a.v)}; }
};

/// As many Reals as a register holds, one a lane. Behaves like one number in the laws.
template <class Real>
struct Pack {
  static constexpr std::size_t kLanes = kPackBytes / sizeof(Real);
  using Vector = typename Registers<Real>::Numbers;
  Vector v;

  Pack() = default;
  HOOKE_HD Pack(Real s)
      : v(s - Vector{}) {}  // NOLINT: a number stands for a pack of it, as in the laws; s - 0 keeps -0
  HOOKE_HD explicit Pack(Vector vector) : v(vector) {}

  friend HOOKE_HD Pack operator+(const Pack& a, const Pack& b) { return Pack(a.v + b.v); }
  friend HOOKE_HD Pack operator-(const Pack& a, const Pack& b) { return Pack(a.v - b.v); }
  friend HOOKE_HD Pack operator*(const Pack& a, const Pack& b) { return Pack(a.v * b.v); }
  friend HOOKE_HD Pack operator/(const Pack& a, const Pack& b) { return Pack(a.v / b.v); }
  friend HOOKE_HD Pack operator-(const Pack& a) { return Pack(-a.v); }
};

#if defined(__AVX512F__)

// compare(a, b, how): a truth value a lane; `how` is one of the instruction set's predicates.
template <int kHow>
HOOKE_HD Mask<float> compare(const Pack<float>& a, const Pack<float>& b) {
  return {_mm512_cmp_ps_mask(a.v, b.v, kHow)};
}
template <int kHow>
HOOKE_HD Mask<double> compare(const Pack<double>& a, const Pack<double>& b) {
  return {_mm512_cmp_pd_mask(a.v, b.v, kHow)};
}
template <class Real>
HOOKE_HD Mask<Real> operator<(const Pack<Real>& a, const Pack<Real>& b) {
  return compare<_CMP_LT_OQ>(a, b);
}
template <class Real>
HOOKE_HD Mask<Real> operator>(const Pack<Real>& a, const Pack<Real>& b) {
  return compare<_CMP_GT_OQ>(a, b);
}
template <class Real>
HOOKE_HD Mask<Real> operator<=(const Pack<Real>& a, const Pack<Real>& b) {
  return compare<_CMP_LE_OQ>(a, b);
}
template <class Real>
HOOKE_HD Mask<Real> operator>=(const Pack<Real>& a, const Pack<Real>& b) {
  return compare<_CMP_GE_OQ>(a, b);
}
template <class Real>
HOOKE_HD Mask<Real> operator==(const Pack<Real>& a, const Pack<Real>& b) {
  return compare<_CMP_EQ_OQ>(a, b);
}
HOOKE_HD Pack<float> select(const Mask<float>& m, const Pack<float>& a, const Pack<float>& b) {
  return Pack<float>(_mm512_mask_blend_ps(m.v, b.v, a.v));
}
HOOKE_HD Pack<double> select(const Mask<double>& m, const Pack<double>& a, const Pack<double>& b) {
  return Pack<double>(_mm512_mask_blend_pd(m.v, b.v, a.v));
}

/// a + b where m holds, else a.
HOOKE_HD Pack<float> add_where(const Mask<float>& m, const Pack<float>& a, const Pack<float>& b) {
  return Pack<float>(_mm512_mask_add_ps(a.v, m.v, a.v, b.v));
}
HOOKE_HD Pack<double> add_where(const Mask<double>& m, const Pack<double>& a, const Pack<double>& b) {
  return Pack<double>(_mm512_mask_add_pd(a.v, m.v, a.v, b.v));
}

#else

template <class Real>
HOOKE_HD Mask<Real> operator<(const Pack<Real>& a, const Pack<Real>& b) {
  return {a.v < b.v};
}
template <class Real>
HOOKE_HD Mask<Real> operator>(const Pack<Real>& a, const Pack<Real>& b) {
  return {a.v > b.v};
}
template <class Real>
HOOKE_HD Mask<Real> operator<=(const Pack<Real>& a, const Pack<Real>& b) {
  return {a.v <= b.v};
}
template <class Real>
HOOKE_HD Mask<Real> operator>=(const Pack<Real>& a, const Pack<Real>& b) {
  return {a.v >= b.v};
}
template <class Real>
HOOKE_HD Mask<Real> operator==(const Pack<Real>& a, const Pack<Real>& b) {
  return {a.v == b.v};
}
template <class Real>
HOOKE_HD Pack<Real> select(const Mask<Real>& m, const Pack<Real>& a, const Pack<Real>& b) {
#if defined(__AVX2__)
  return Pack<Real>(m.v ? a.v : b.v);
#else  // bit by bit, as the processor does: GCC 12 fails on some uses of ?:
  using Bits = typename Mask<Real>::Bits;
  return Pack<Real>((typename Pack<Real>::Vector)(((Bits)a.v & m.v) | ((Bits)b.v & ~m.v)));
#endif
}

/// a + b where m holds, else a. No lane of a may be -0, which adding 0 would change.
template <class Real>
HOOKE_HD Pack<Real> add_where(const Mask<Real>& m, const Pack<Real>& a, const Pack<Real>& b) {
  return a + select(m, b, Pack<Real>(Real(0)));
}

#endif

#if defined(__AVX512F__)

HOOKE_HD Pack<float> sqrt_of(const Pack<float>& a) { return Pack<float>(_mm512_sqrt_ps(a.v)); }
HOOKE_HD Pack<double> sqrt_of(const Pack<double>& a) { return Pack<double>(_mm512_sqrt_pd(a.v)); }
HOOKE_HD unsigned bits(const Mask<float>& m) { return m.v; }
HOOKE_HD unsigned bits(const Mask<double>& m) { return m.v; }

#elif defined(__AVX2__)

HOOKE_HD Pack<float> sqrt_of(const Pack<float>& a) { return Pack<float>(_mm256_sqrt_ps(a.v)); }
HOOKE_HD Pack<double> sqrt_of(const Pack<double>& a) { return Pack<double>(_mm256_sqrt_pd(a.v)); }
HOOKE_HD unsigned bits(const Mask<float>& m) { return static_cast<unsigned>(_mm256_movemask_ps((__m256)m.v)); }
HOOKE_HD unsigned bits(const Mask<double>& m) { return static_cast<unsigned>(_mm256_movemask_pd((__m256d)m.v)); }

#else

HOOKE_HD Pack<float> sqrt_of(const Pack<float>& a) {
  return Pack<float>(
      FloatVector{__builtin_sqrtf(a.v[0]), __builtin_sqrtf(a.v[1]), __builtin_sqrtf(a.v[2]), __builtin_sqrtf(a.v[3])});
}
HOOKE_HD Pack<double> sqrt_of(const Pack<double>& a) {
  return Pack<double>(DoubleVector{__builtin_sqrt(a.v[0]), __builtin_sqrt(a.v[1])});
}
HOOKE_HD unsigned bits(const Mask<float>& m) {
  const Int32Vector set = m.v & Int32Vector{1, 2, 4, 8};
  return static_cast<unsigned>((set[0] | set[1]) | (set[2] | set[3]));
}
HOOKE_HD unsigned bits(const Mask<double>& m) { return static_cast<unsigned>((m.v[0] & 1) | (m.v[1] & 2)); }

#endif

/// The numbers without their signs.
HOOKE_HD Pack<float> magnitude(const Pack<float>& a) {
  return Pack<float>((FloatVector)((Int32Vector)a.v & 0x7fffffff));
}
HOOKE_HD Pack<double> magnitude(const Pack<double>& a) {
  return Pack<double>((DoubleVector)((Int64Vector)a.v & 0x7fffffffffffffff));
}

/// The lanes whose bits are set; bits beyond the last lane don't count.
template <class Real>
HOOKE_HD Mask<Real> lanes_of(unsigned set) {
#if defined(__AVX512F__)
  return {static_cast<typename Mask<Real>::Bits>(set)};
#else
  Mask<Real> m;
  for (std::size_t lane = 0; lane < Pack<Real>::kLanes; ++lane) m.v[lane] = (set >> lane & 1U) != 0 ? -1 : 0;
  return m;
#endif
}

/// a where m holds, else 0.
template <class Real>
HOOKE_HD Pack<Real> only_where(const Mask<Real>& m, const Pack<Real>& a) {
#if defined(__AVX512F__)
  return select(m, a, Pack<Real>(Real(0)));
#else
  using Bits = typename Mask<Real>::Bits;
  return Pack<Real>((typename Pack<Real>::Vector)((Bits)a.v & m.v));
#endif
}

// bits() has one bit per lane.
template <class Real>
HOOKE_HD bool any(const Mask<Real>& m) {
#if defined(__AVX2__)
  return bits(m) != 0;
#else
  const auto halves = (Int64Vector)m.v;
  return (halves[0] | halves[1]) != 0;
#endif
}

/// Asks for the cache line of an address ahead of time.
HOOKE_HD void prefetch(const void* at) { __builtin_prefetch(at); }

/// Consecutive numbers, one a lane, at any address.
template <class Real>
HOOKE_HD Pack<Real> load(const Real* from) {
  Pack<Real> a;
  __builtin_memcpy(&a.v, from, sizeof(a.v));
  return a;
}
template <class Real>
HOOKE_HD void store(Real* to, const Pack<Real>& a) {
  __builtin_memcpy(to, &a.v, sizeof(a.v));
}

}  // namespace hooke::HOOKE_ISA
