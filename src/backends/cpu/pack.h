// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// SIMD packs: the one file with intrinsics. Included by force_pass.inl inside a file that is compiled for one
// instruction set and names its namespace HOOKE_ISA; no include guard is shared between instruction sets. Everything
// is always inlined, so that no function built for a newer processor can be the copy that the linker keeps.

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#include "hooke/base/real.h"

namespace hooke::HOOKE_ISA {

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

/// One truth value a lane: a bit, or all bits set or none.
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
  return Pack<Real>(m.v ? a.v : b.v);
}

/// a + b where m holds, else a: of what is not -0, so that adding 0 does not alter it.
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

HOOKE_HD Pack<float> sqrt_of(const Pack<float>& a) { return Pack<float>(_mm_sqrt_ps(a.v)); }
HOOKE_HD Pack<double> sqrt_of(const Pack<double>& a) { return Pack<double>(_mm_sqrt_pd(a.v)); }
HOOKE_HD unsigned bits(const Mask<float>& m) { return static_cast<unsigned>(_mm_movemask_ps((__m128)m.v)); }
HOOKE_HD unsigned bits(const Mask<double>& m) { return static_cast<unsigned>(_mm_movemask_pd((__m128d)m.v)); }

#endif

// bits() has a bit a lane.
template <class Real>
HOOKE_HD bool any(const Mask<Real>& m) {
  return bits(m) != 0;
}

/// Four packs: what a 4 x 4 transpose of quads gives, and takes.
template <class Real>
struct Quad {
  Pack<Real> a, b, c, d;
};

// Quads of four numbers are loaded lane by lane into the 128-bit (double: 256-bit) parts of four registers and
// transposed there. `at(lane)` is the address of the lane's quad.

#if defined(__AVX512F__)

HOOKE_HD Quad<float> transpose(__m512 r0, __m512 r1, __m512 r2, __m512 r3) {
  const __m512d xy01 = _mm512_castps_pd(_mm512_unpacklo_ps(r0, r1)),
                zw01 = _mm512_castps_pd(_mm512_unpackhi_ps(r0, r1));
  const __m512d xy23 = _mm512_castps_pd(_mm512_unpacklo_ps(r2, r3)),
                zw23 = _mm512_castps_pd(_mm512_unpackhi_ps(r2, r3));
  return {Pack<float>((_mm512_castpd_ps(_mm512_unpacklo_pd(xy01, xy23)))),
          Pack<float>((_mm512_castpd_ps(_mm512_unpackhi_pd(xy01, xy23)))),
          Pack<float>((_mm512_castpd_ps(_mm512_unpacklo_pd(zw01, zw23)))),
          Pack<float>((_mm512_castpd_ps(_mm512_unpackhi_pd(zw01, zw23))))};
}
template <class At>
HOOKE_HD Quad<float> load_quads(float, const At& at) {
  __m512 r[4];
  for (int k = 0; k < 4; ++k) {
    r[k] = _mm512_castps128_ps512(_mm_load_ps(at(k)));
    r[k] = _mm512_insertf32x4(r[k], _mm_load_ps(at(k + 4)), 1);
    r[k] = _mm512_insertf32x4(r[k], _mm_load_ps(at(k + 8)), 2);
    r[k] = _mm512_insertf32x4(r[k], _mm_load_ps(at(k + 12)), 3);
  }
  return transpose(r[0], r[1], r[2], r[3]);
}
template <class At>
HOOKE_HD void store_quads(const Quad<float>& q, const At& at) {
  const Quad<float> t = transpose(q.a.v, q.b.v, q.c.v, q.d.v);
  const __m512 r[4] = {t.a.v, t.b.v, t.c.v, t.d.v};
  for (int k = 0; k < 4; ++k) {
    _mm_store_ps(at(k), _mm512_castps512_ps128(r[k]));
    _mm_store_ps(at(k + 4), _mm512_extractf32x4_ps(r[k], 1));
    _mm_store_ps(at(k + 8), _mm512_extractf32x4_ps(r[k], 2));
    _mm_store_ps(at(k + 12), _mm512_extractf32x4_ps(r[k], 3));
  }
}
// Parts of registers: r0 holds the quads of lanes 0 and 2, r1 of 1 and 3, r2 of 4 and 6, r3 of 5 and 7.
template <class At>
HOOKE_HD Quad<double> load_quads(double, const At& at) {
  const auto two = [&](int low, int high) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_load_pd(at(low))), _mm256_load_pd(at(high)), 1);
  };
  const __m512d r0 = two(0, 2), r1 = two(1, 3), r2 = two(4, 6), r3 = two(5, 7);
  const __m512d xz0 = _mm512_unpacklo_pd(r0, r1), yw0 = _mm512_unpackhi_pd(r0, r1);
  const __m512d xz1 = _mm512_unpacklo_pd(r2, r3), yw1 = _mm512_unpackhi_pd(r2, r3);
  return {Pack<double>((_mm512_shuffle_f64x2(xz0, xz1, 0x88))), Pack<double>((_mm512_shuffle_f64x2(yw0, yw1, 0x88))),
          Pack<double>((_mm512_shuffle_f64x2(xz0, xz1, 0xdd))), Pack<double>((_mm512_shuffle_f64x2(yw0, yw1, 0xdd)))};
}

#elif defined(__AVX2__)

HOOKE_HD Quad<float> transpose(__m256 r0, __m256 r1, __m256 r2, __m256 r3) {
  const __m256d xy01 = _mm256_castps_pd(_mm256_unpacklo_ps(r0, r1)),
                zw01 = _mm256_castps_pd(_mm256_unpackhi_ps(r0, r1));
  const __m256d xy23 = _mm256_castps_pd(_mm256_unpacklo_ps(r2, r3)),
                zw23 = _mm256_castps_pd(_mm256_unpackhi_ps(r2, r3));
  return {Pack<float>((_mm256_castpd_ps(_mm256_unpacklo_pd(xy01, xy23)))),
          Pack<float>((_mm256_castpd_ps(_mm256_unpackhi_pd(xy01, xy23)))),
          Pack<float>((_mm256_castpd_ps(_mm256_unpacklo_pd(zw01, zw23)))),
          Pack<float>((_mm256_castpd_ps(_mm256_unpackhi_pd(zw01, zw23))))};
}
template <class At>
HOOKE_HD Quad<float> load_quads(float, const At& at) {
  __m256 r[4];
  for (int k = 0; k < 4; ++k) {
    r[k] = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(at(k))), _mm_load_ps(at(k + 4)), 1);
  }
  return transpose(r[0], r[1], r[2], r[3]);
}
template <class At>
HOOKE_HD void store_quads(const Quad<float>& q, const At& at) {
  const Quad<float> t = transpose(q.a.v, q.b.v, q.c.v, q.d.v);
  const __m256 r[4] = {t.a.v, t.b.v, t.c.v, t.d.v};
  for (int k = 0; k < 4; ++k) {
    _mm_store_ps(at(k), _mm256_castps256_ps128(r[k]));
    _mm_store_ps(at(k + 4), _mm256_extractf128_ps(r[k], 1));
  }
}
template <class At>
HOOKE_HD Quad<double> load_quads(double, const At& at) {
  const __m256d r0 = _mm256_load_pd(at(0)), r1 = _mm256_load_pd(at(1)), r2 = _mm256_load_pd(at(2)),
                r3 = _mm256_load_pd(at(3));
  const __m256d xz0 = _mm256_unpacklo_pd(r0, r1), yw0 = _mm256_unpackhi_pd(r0, r1);
  const __m256d xz1 = _mm256_unpacklo_pd(r2, r3), yw1 = _mm256_unpackhi_pd(r2, r3);
  return {
      Pack<double>((_mm256_permute2f128_pd(xz0, xz1, 0x20))), Pack<double>((_mm256_permute2f128_pd(yw0, yw1, 0x20))),
      Pack<double>((_mm256_permute2f128_pd(xz0, xz1, 0x31))), Pack<double>((_mm256_permute2f128_pd(yw0, yw1, 0x31)))};
}

#else

HOOKE_HD Quad<float> transpose(__m128 r0, __m128 r1, __m128 r2, __m128 r3) {
  _MM_TRANSPOSE4_PS(r0, r1, r2, r3);
  return {Pack<float>((r0)), Pack<float>((r1)), Pack<float>((r2)), Pack<float>((r3))};
}
template <class At>
HOOKE_HD Quad<float> load_quads(float, const At& at) {
  return transpose(_mm_load_ps(at(0)), _mm_load_ps(at(1)), _mm_load_ps(at(2)), _mm_load_ps(at(3)));
}
template <class At>
HOOKE_HD void store_quads(const Quad<float>& q, const At& at) {
  const Quad<float> t = transpose(q.a.v, q.b.v, q.c.v, q.d.v);
  _mm_store_ps(at(0), t.a.v);
  _mm_store_ps(at(1), t.b.v);
  _mm_store_ps(at(2), t.c.v);
  _mm_store_ps(at(3), t.d.v);
}
template <class At>
HOOKE_HD Quad<double> load_quads(double, const At& at) {
  const __m128d xy0 = _mm_load_pd(at(0)), zw0 = _mm_load_pd(at(0) + 2);
  const __m128d xy1 = _mm_load_pd(at(1)), zw1 = _mm_load_pd(at(1) + 2);
  return {Pack<double>((_mm_unpacklo_pd(xy0, xy1))), Pack<double>((_mm_unpackhi_pd(xy0, xy1))),
          Pack<double>((_mm_unpacklo_pd(zw0, zw1))), Pack<double>((_mm_unpackhi_pd(zw0, zw1)))};
}

#endif

// Doubles are stored lane by lane: a group is stored once and loaded a dozen times.
template <class At>
HOOKE_HD void store_quads(const Quad<double>& q, const At& at) {
  for (std::size_t lane = 0; lane < Pack<double>::kLanes; ++lane) {
    double* to = at(static_cast<int>(lane));
    to[0] = q.a.v[lane];
    to[1] = q.b.v[lane];
    to[2] = q.c.v[lane];
    to[3] = q.d.v[lane];
  }
}

/// Two quads behind each other, e.g. a particle's record: `at(lane)` is the address of the lane's eight numbers.
template <class Real>
struct TwoQuads {
  Quad<Real> first, second;
};

#if defined(__AVX512F__)

// A register holds the records of lanes k and k + 4: quads first, second, first, second. What four such registers give
// when transposed is put together with what the other four give.
template <class At>
HOOKE_HD TwoQuads<float> load_two_quads(float, const At& at) {
  const auto two = [&](int low, int high) {
    const __m512d part = _mm512_castpd256_pd512(_mm256_castps_pd(_mm256_load_ps(at(low))));
    return _mm512_castpd_ps(_mm512_insertf64x4(part, _mm256_castps_pd(_mm256_load_ps(at(high))), 1));
  };
  const Quad<float> low = transpose(two(0, 4), two(1, 5), two(2, 6), two(3, 7));
  const Quad<float> high = transpose(two(8, 12), two(9, 13), two(10, 14), two(11, 15));
  const auto first = [](const Pack<float>& a, const Pack<float>& b) {
    return Pack<float>(_mm512_shuffle_f32x4(a.v, b.v, 0x88));
  };
  const auto second = [](const Pack<float>& a, const Pack<float>& b) {
    return Pack<float>(_mm512_shuffle_f32x4(a.v, b.v, 0xdd));
  };
  return {{first(low.a, high.a), first(low.b, high.b), first(low.c, high.c), first(low.d, high.d)},
          {second(low.a, high.a), second(low.b, high.b), second(low.c, high.c), second(low.d, high.d)}};
}
template <class At>
HOOKE_HD void store_two_quads(const TwoQuads<float>& q, const At& at) {
  // Parts of two registers: first's, second's, first's, second's.
  const auto woven = [](const Pack<float>& first, const Pack<float>& second, int part) {
    const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11),
                  high = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
    return _mm512_castpd_ps(
        _mm512_permutex2var_pd(_mm512_castps_pd(first.v), part == 0 ? low : high, _mm512_castps_pd(second.v)));
  };
  for (int part = 0; part < 2; ++part) {
    const Quad<float> t = transpose(woven(q.first.a, q.second.a, part), woven(q.first.b, q.second.b, part),
                                    woven(q.first.c, q.second.c, part), woven(q.first.d, q.second.d, part));
    const __m512 r[4] = {t.a.v, t.b.v, t.c.v, t.d.v};
    for (int k = 0; k < 4; ++k) {
      const __m512d both = _mm512_castps_pd(r[k]);
      _mm256_store_pd(reinterpret_cast<double*>(at(8 * part + k)), _mm512_castpd512_pd256(both));
      _mm256_store_pd(reinterpret_cast<double*>(at(8 * part + k + 4)), _mm512_extractf64x4_pd(both, 1));
    }
  }
}
template <class At>
HOOKE_HD TwoQuads<double> load_two_quads(double, const At& at) {
  return {load_quads(double{}, at), load_quads(double{}, [&](int lane) { return at(lane) + 4; })};
}

#else

template <class Real, class At>
HOOKE_HD TwoQuads<Real> load_two_quads(Real, const At& at) {
  return {load_quads(Real{}, at), load_quads(Real{}, [&](int lane) { return at(lane) + 4; })};
}

#endif

template <class Real, class At>
HOOKE_HD void store_two_quads(const TwoQuads<Real>& q, const At& at) {
  store_quads(q.first, at);
  store_quads(q.second, [&](int lane) { return at(lane) + 4; });
}

/// Up to 16 numbers, `stride` apart from `from` on, of which each lane asks for one: lookup() takes whole numbers from
/// 0 to count - 1. In registers where those can be asked.
template <class Real>
struct SmallTable {
  Real entries[16] = {};
  HOOKE_HD SmallTable(const Real* from, std::size_t stride, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) entries[k] = from[k * stride];
  }
  HOOKE_HD Pack<Real> lookup(const Pack<Real>& index) const {
    Pack<Real> found;
    for (std::size_t lane = 0; lane < Pack<Real>::kLanes; ++lane) {
      found.v[lane] = entries[static_cast<std::size_t>(index.v[lane])];
    }
    return found;
  }
};

#if defined(__AVX512F__)

template <>
struct SmallTable<float> {
  __m512 entries;
  HOOKE_HD SmallTable(const float* from, std::size_t stride, std::size_t count) {
    alignas(64) float gathered[16] = {};
    for (std::size_t k = 0; k < count; ++k) gathered[k] = from[k * stride];
    entries = _mm512_load_ps(gathered);
  }
  HOOKE_HD Pack<float> lookup(const Pack<float>& index) const {
    return Pack<float>(_mm512_permutexvar_ps(_mm512_cvttps_epi32(index.v), entries));
  }
};
template <>
struct SmallTable<double> {
  __m512d low, high;
  HOOKE_HD SmallTable(const double* from, std::size_t stride, std::size_t count) {
    alignas(64) double gathered[16] = {};
    for (std::size_t k = 0; k < count; ++k) gathered[k] = from[k * stride];
    low = _mm512_load_pd(gathered);
    high = _mm512_load_pd(gathered + 8);
  }
  HOOKE_HD Pack<double> lookup(const Pack<double>& index) const {
    return Pack<double>(_mm512_permutex2var_pd(low, _mm512_cvtepi32_epi64(_mm512_cvttpd_epi32(index.v)), high));
  }
};

#elif defined(__AVX2__)

template <>
struct SmallTable<float> {
  __m256 low, high;
  HOOKE_HD SmallTable(const float* from, std::size_t stride, std::size_t count) {
    alignas(32) float gathered[16] = {};
    for (std::size_t k = 0; k < count; ++k) gathered[k] = from[k * stride];
    low = _mm256_load_ps(gathered);
    high = _mm256_load_ps(gathered + 8);
  }
  HOOKE_HD Pack<float> lookup(const Pack<float>& index) const {
    const __m256i at = _mm256_cvttps_epi32(index.v);
    const __m256 is_high = _mm256_castsi256_ps(_mm256_slli_epi32(at, 28));  // 8 to 15
    return Pack<float>(
        _mm256_blendv_ps(_mm256_permutevar8x32_ps(low, at), _mm256_permutevar8x32_ps(high, at), is_high));
  }
};

#endif

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

/// 0, 1, 2, ...: as many as a register holds.
HOOKE_HD Int32Vector ascending() {
  Int32Vector numbers;
  for (std::size_t lane = 0; lane < kPackBytes / sizeof(std::int32_t); ++lane) {
    numbers[lane] = static_cast<std::int32_t>(lane);
  }
  return numbers;
}

// append_where_less(to, numbers, a, b): writes those of the numbers where a < b in that lane behind each other and
// returns how many. May write as many numbers as a register holds.

#if defined(__AVX512F__)

HOOKE_HD std::size_t append_where_less(std::int32_t* to, const Int32Vector& numbers, const Pack<float>& a,
                                       const Pack<float>& b) {
  const __mmask16 set = _mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ);
  const auto count = static_cast<std::size_t>(__builtin_popcount(set));
  const __m512i packed = _mm512_maskz_compress_epi32(set, (__m512i)numbers);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm512_castsi512_si256(packed));  // most often all there is
  if (count > 8) _mm512_storeu_si512(to, packed);
  return count;
}
HOOKE_HD std::size_t append_where_less(std::int32_t* to, const Int32Vector& numbers, const Pack<double>& a,
                                       const Pack<double>& b) {
  const __mmask8 set = _mm512_cmp_pd_mask(a.v, b.v, _CMP_LT_OQ);
  _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(set, (__m512i)numbers));
  return static_cast<std::size_t>(__builtin_popcount(set));
}

#elif defined(__AVX2__)

// For each set of eight lanes: which lanes are in it, as bytes.
struct LaneTable {
  std::uint64_t lanes[256];
};
constexpr LaneTable make_lane_table() {
  LaneTable table{};
  for (unsigned set = 0; set < 256; ++set) {
    for (unsigned lane = 0, at = 0; lane < 8; ++lane) {
      if ((set >> lane & 1U) != 0) table.lanes[set] |= std::uint64_t{lane} << 8 * at++;
    }
  }
  return table;
}
static constexpr LaneTable kLaneTable = make_lane_table();

HOOKE_HD std::size_t append(std::int32_t* to, const Int32Vector& numbers, unsigned set) {
  const __m256i lanes = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(kLaneTable.lanes[set])));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_permutevar8x32_epi32((__m256i)numbers, lanes));
  return static_cast<std::size_t>(__builtin_popcount(set));
}
HOOKE_HD std::size_t append_where_less(std::int32_t* to, const Int32Vector& numbers, const Pack<float>& a,
                                       const Pack<float>& b) {
  return append(to, numbers, static_cast<unsigned>(_mm256_movemask_ps((__m256)(a < b).v)));
}
HOOKE_HD std::size_t append_where_less(std::int32_t* to, const Int32Vector& numbers, const Pack<double>& a,
                                       const Pack<double>& b) {
  return append(to, numbers, static_cast<unsigned>(_mm256_movemask_pd((__m256d)(a < b).v)));
}

#else

// Each is written, the next one over it if its lane is not set.
template <class Real>
HOOKE_HD std::size_t append_where_less(std::int32_t* to, const Int32Vector& numbers, const Pack<Real>& a,
                                       const Pack<Real>& b) {
  const unsigned set = bits(a < b);
  std::size_t count = 0;
  for (std::size_t lane = 0; lane < Pack<Real>::kLanes; ++lane) {
    to[count] = numbers[lane];
    count += set >> lane & 1U;
  }
  return count;
}

#endif

// min_of(a, b), max_of(a, b): lane by lane the smaller one, and the larger one, of numbers.

#if defined(__AVX512F__)

HOOKE_HD Pack<double> min_of(const Pack<double>& a, const Pack<double>& b) {
  return Pack<double>(_mm512_min_pd(a.v, b.v));
}
HOOKE_HD Pack<double> max_of(const Pack<double>& a, const Pack<double>& b) {
  return Pack<double>(_mm512_max_pd(a.v, b.v));
}

#elif defined(__AVX2__)

HOOKE_HD Pack<double> min_of(const Pack<double>& a, const Pack<double>& b) {
  return Pack<double>(_mm256_min_pd(a.v, b.v));
}
HOOKE_HD Pack<double> max_of(const Pack<double>& a, const Pack<double>& b) {
  return Pack<double>(_mm256_max_pd(a.v, b.v));
}

#else

HOOKE_HD Pack<double> min_of(const Pack<double>& a, const Pack<double>& b) {
  return Pack<double>(_mm_min_pd(a.v, b.v));
}
HOOKE_HD Pack<double> max_of(const Pack<double>& a, const Pack<double>& b) {
  return Pack<double>(_mm_max_pd(a.v, b.v));
}

#endif

// Numbers of 32 and 64 bits, as many as a pack of doubles has lanes.
typedef std::uint32_t WordVector __attribute__((vector_size(kPackBytes / 2)));
typedef std::uint64_t LongVector __attribute__((vector_size(kPackBytes)));

/// Doubles with these upper and lower halves.
HOOKE_HD Pack<double> join_halves(const WordVector& upper, const WordVector& lower) {
  const LongVector bits = __builtin_convertvector(upper, LongVector) << 32 | __builtin_convertvector(lower, LongVector);
  return Pack<double>((DoubleVector)bits);
}
HOOKE_HD Pack<double> load_bits(const std::uint64_t* from) {
  Pack<double> a;
  __builtin_memcpy(&a.v, from, sizeof(a.v));
  return a;
}
HOOKE_HD void store_bits(std::uint64_t* to, const Pack<double>& a) { __builtin_memcpy(to, &a.v, sizeof(a.v)); }
/// The lower 32 bits of each lane.
HOOKE_HD WordVector lower_half(const Pack<double>& a) { return __builtin_convertvector((LongVector)a.v, WordVector); }
HOOKE_HD WordVector load_words(const std::uint32_t* from) {
  WordVector a;
  __builtin_memcpy(&a, from, sizeof(a));
  return a;
}
HOOKE_HD void store(std::uint32_t* to, const WordVector& a) { __builtin_memcpy(to, &a, sizeof(a)); }

}  // namespace hooke::HOOKE_ISA
