// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

// Pack operations that the search needs beside arithmetic: to keep near points, and to sort keys. Rules of inclusion as
// in pack.h.

#include "hooke/backends/cpu/pack.h"

namespace hooke::HOOKE_ISA {

/// 0, 1, 2, ...: as many as a register holds.
HOOKE_HD Int32Vector ascending() {
  Int32Vector numbers;
  for (std::size_t lane = 0; lane < kPackBytes / sizeof(std::int32_t); ++lane) {
    numbers[lane] = static_cast<std::int32_t>(lane);
  }
  return numbers;
}

// append_where_less(to, numbers, a, b): writes the numbers of the lanes where a < b one after another and returns how
// many. May write as many numbers as a register holds.

#if defined(__AVX512F__)

HOOKE_HD std::size_t append_where_less(std::int32_t* to, const Int32Vector& numbers, const Pack<float>& a,
                                       const Pack<float>& b) {
  const __mmask16 set = _mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ);
  const auto count = static_cast<std::size_t>(__builtin_popcount(set));
  const __m512i packed = _mm512_maskz_compress_epi32(set, (__m512i)numbers);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm512_castsi512_si256(packed));  // usually all of them
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

// For each set of eight lanes: the lanes in it, as bytes.
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

// Every number is written; the next one overwrites it if its lane is not set.
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

// min_of(a, b), max_of(a, b): the smaller and the larger number, lane by lane. Neither may be NaN.

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

HOOKE_HD Pack<double> min_of(const Pack<double>& a, const Pack<double>& b) { return select(a < b, a, b); }
HOOKE_HD Pack<double> max_of(const Pack<double>& a, const Pack<double>& b) { return select(a > b, a, b); }

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
/// As many bytes, widened to words.
HOOKE_HD WordVector load_bytes(const std::uint8_t* from) {
  typedef std::uint8_t ByteVector __attribute__((vector_size(kPackBytes / 8)));
  ByteVector a;
  __builtin_memcpy(&a, from, sizeof(a));
  return __builtin_convertvector(a, WordVector);
}
HOOKE_HD void store(std::uint32_t* to, const WordVector& a) { __builtin_memcpy(to, &a, sizeof(a)); }

}  // namespace hooke::HOOKE_ISA
