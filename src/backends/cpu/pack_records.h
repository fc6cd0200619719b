// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

// Packs of records and of table entries, for the force pass: rules of inclusion as in pack.h.

#include "hooke/backends/cpu/pack.h"

namespace hooke::HOOKE_ISA {

/// Four packs: the result and the operand of a 4 x 4 transpose of quads.
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

HOOKE_HD Quad<float> transpose(const FloatVector& r0, const FloatVector& r1, const FloatVector& r2,
                               const FloatVector& r3) {
  const FloatVector xy01 = __builtin_shufflevector(r0, r1, 0, 4, 1, 5),
                    xy23 = __builtin_shufflevector(r2, r3, 0, 4, 1, 5);
  const FloatVector zw01 = __builtin_shufflevector(r0, r1, 2, 6, 3, 7),
                    zw23 = __builtin_shufflevector(r2, r3, 2, 6, 3, 7);
  return {Pack<float>(__builtin_shufflevector(xy01, xy23, 0, 1, 4, 5)),
          Pack<float>(__builtin_shufflevector(xy01, xy23, 2, 3, 6, 7)),
          Pack<float>(__builtin_shufflevector(zw01, zw23, 0, 1, 4, 5)),
          Pack<float>(__builtin_shufflevector(zw01, zw23, 2, 3, 6, 7))};
}
template <class At>
HOOKE_HD Quad<float> load_quads(float, const At& at) {
  return transpose(load(at(0)).v, load(at(1)).v, load(at(2)).v, load(at(3)).v);
}
template <class At>
HOOKE_HD void store_quads(const Quad<float>& q, const At& at) {
  const Quad<float> t = transpose(q.a.v, q.b.v, q.c.v, q.d.v);
  store(at(0), t.a);
  store(at(1), t.b);
  store(at(2), t.c);
  store(at(3), t.d);
}
template <class At>
HOOKE_HD Quad<double> load_quads(double, const At& at) {
  const DoubleVector xy0 = load(at(0)).v, zw0 = load(at(0) + 2).v, xy1 = load(at(1)).v, zw1 = load(at(1) + 2).v;
  return {Pack<double>(__builtin_shufflevector(xy0, xy1, 0, 2)), Pack<double>(__builtin_shufflevector(xy0, xy1, 1, 3)),
          Pack<double>(__builtin_shufflevector(zw0, zw1, 0, 2)), Pack<double>(__builtin_shufflevector(zw0, zw1, 1, 3))};
}

#endif

// Doubles are stored lane by lane: a slice is stored once and loaded a dozen times.
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

/// Two consecutive quads, e.g. a particle's record: `at(lane)` is the address of the lane's eight numbers.
template <class Real>
struct TwoQuads {
  Quad<Real> first, second;
};

#if defined(__AVX512F__)

// A register holds the records of lanes k and k + 4: quads first, second, first, second. Four such registers are
// transposed, and combined with the transpose of the other four.
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

#elif defined(__AVX2__)

// A register holds a record: first quad, second. Four such registers are transposed, and combined with the transpose of
// the other four.
template <class At>
HOOKE_HD TwoQuads<float> load_two_quads(float, const At& at) {
  const Quad<float> low =
      transpose(_mm256_load_ps(at(0)), _mm256_load_ps(at(1)), _mm256_load_ps(at(2)), _mm256_load_ps(at(3)));
  const Quad<float> high =
      transpose(_mm256_load_ps(at(4)), _mm256_load_ps(at(5)), _mm256_load_ps(at(6)), _mm256_load_ps(at(7)));
  const auto first = [](const Pack<float>& a, const Pack<float>& b) {
    return Pack<float>(_mm256_insertf128_ps(a.v, _mm256_castps256_ps128(b.v), 1));
  };
  const auto second = [](const Pack<float>& a, const Pack<float>& b) {
    return Pack<float>(_mm256_permute2f128_ps(a.v, b.v, 0x31));
  };
  return {{first(low.a, high.a), first(low.b, high.b), first(low.c, high.c), first(low.d, high.d)},
          {second(low.a, high.a), second(low.b, high.b), second(low.c, high.c), second(low.d, high.d)}};
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

/// Consecutive vectors, one a lane.
template <class Real>
HOOKE_HD Vec3<Pack<Real>> load_vectors(const Vec3<Real>* from) {
  Vec3<Pack<Real>> a;
  for (std::size_t lane = 0; lane < Pack<Real>::kLanes; ++lane) {
    a.x.v[lane] = from[lane].x;
    a.y.v[lane] = from[lane].y;
    a.z.v[lane] = from[lane].z;
  }
  return a;
}

/// A table of the 16 numbers at `from`, which is aligned to the table's size. lookup() gives each lane the number of
/// its index, a whole number from 0 to 15. The table is in registers where the processor can index them.
template <class Real>
struct SmallTable {
  const Real* entries;
  HOOKE_HD explicit SmallTable(const Real* from) : entries(from) {}
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
  HOOKE_HD explicit SmallTable(const float* from) : entries(_mm512_load_ps(from)) {}
  HOOKE_HD Pack<float> lookup(const Pack<float>& index) const {
    return Pack<float>(_mm512_permutexvar_ps(_mm512_cvttps_epi32(index.v), entries));
  }
};
template <>
struct SmallTable<double> {
  __m512d low, high;
  HOOKE_HD explicit SmallTable(const double* from) : low(_mm512_load_pd(from)), high(_mm512_load_pd(from + 8)) {}
  HOOKE_HD Pack<double> lookup(const Pack<double>& index) const {
    return Pack<double>(_mm512_permutex2var_pd(low, _mm512_cvtepi32_epi64(_mm512_cvttpd_epi32(index.v)), high));
  }
};

#elif defined(__AVX2__)

template <>
struct SmallTable<float> {
  __m256 low, high;
  HOOKE_HD explicit SmallTable(const float* from) : low(_mm256_load_ps(from)), high(_mm256_load_ps(from + 8)) {}
  HOOKE_HD Pack<float> lookup(const Pack<float>& index) const {
    const __m256i at = _mm256_cvttps_epi32(index.v);
    const __m256 is_high = _mm256_castsi256_ps(_mm256_slli_epi32(at, 28));  // 8 to 15
    return Pack<float>(
        _mm256_blendv_ps(_mm256_permutevar8x32_ps(low, at), _mm256_permutevar8x32_ps(high, at), is_high));
  }
};

#endif

}  // namespace hooke::HOOKE_ISA
