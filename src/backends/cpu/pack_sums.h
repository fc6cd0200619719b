// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

// Exact sums of many numbers, lane by lane: rules of inclusion as in pack.h.

#include "hooke/backends/cpu/pack.h"
#include "hooke/passes/exact_parts.h"

namespace hooke::HOOKE_ISA {

/// The lower and the upper half of a pack, in doubles.
struct Widened {
  Pack<double> low, high;
};

#if defined(__AVX512F__)

HOOKE_HD Widened widen(const Pack<float>& a) {
  const __m256 high = _mm256_castpd_ps(_mm512_extractf64x4_pd(_mm512_castps_pd(a.v), 1));
  return {Pack<double>(_mm512_cvtps_pd(_mm512_castps512_ps256(a.v))), Pack<double>(_mm512_cvtps_pd(high))};
}

#elif defined(__AVX2__)

HOOKE_HD Widened widen(const Pack<float>& a) {
  return {Pack<double>(_mm256_cvtps_pd(_mm256_castps256_ps128(a.v))),
          Pack<double>(_mm256_cvtps_pd(_mm256_extractf128_ps(a.v, 1)))};
}

#else

HOOKE_HD Widened widen(const Pack<float>& a) {
  return {Pack<double>(DoubleVector{a.v[0], a.v[1]}), Pack<double>(DoubleVector{a.v[2], a.v[3]})};
}

#endif

// a + b minus the rounded `sum`, exactly (Knuth, The Art of Computer Programming, 4.2.2, theorem B).
HOOKE_HD Pack<double> rounded_off(const Pack<double>& a, const Pack<double>& b, const Pack<double>& sum) {
  const Pack<double> of_b = sum - a;
  return (a - (sum - of_b)) + (b - of_b);
}

// Whether a sum has been rounded since this object was made. With AVX2 the processor's flag says so, and the compiler
// moves no access to memory across these functions; without, every sum is examined.
class RoundingWatch {
 public:
#if defined(__AVX2__)
  HOOKE_HD RoundingWatch() {
    _mm_setcsr(_mm_getcsr() & ~_MM_EXCEPT_INEXACT);
    asm volatile("" ::: "memory");
  }
  HOOKE_HD Pack<double> add(const Pack<double>& a, const Pack<double>& b) { return a + b; }
  HOOKE_HD bool has_rounded() const {
    asm volatile("" ::: "memory");
    return (_mm_getcsr() & _MM_EXCEPT_INEXACT) != 0;
  }
#else
  HOOKE_HD Pack<double> add(const Pack<double>& a, const Pack<double>& b) {
    const Pack<double> sum = a + b;
    exact_ = exact_ & (rounded_off(a, b, sum) == Pack<double>(0.0));
    return sum;
  }
  HOOKE_HD bool has_rounded() const { return any(!exact_); }

 private:
  Mask<double> exact_ = Pack<double>(0.0) == Pack<double>(0.0);
#endif
};

// sum_lanes(values, count, to): sums whole packs of numbers lane by lane, writes the sums and returns how many; 0 where
// they would not be exact.

// Doubles hold the exact sums of floats that do not differ too much in size.
HOOKE_HD std::size_t sum_lanes(const float* values, std::size_t count, double* to) {
  constexpr std::size_t kLanes = Pack<float>::kLanes;
  RoundingWatch watch;
  Pack<double> low(0.0), high(0.0);
  for (std::size_t k = 0; k < count; k += kLanes) {
    const Widened wide = widen(load(values + k));
    low = watch.add(low, wide.low);
    high = watch.add(high, wide.high);
  }
  store(to, low);
  store(to + kLanes / 2, high);
  return watch.has_rounded() ? 0 : kLanes;
}

// Sums of doubles, and of their rounding errors.
HOOKE_HD std::size_t sum_lanes(const double* values, std::size_t count, double* to) {
  constexpr std::size_t kLanes = Pack<double>::kLanes;
  Pack<double> sum(0.0), left(0.0);
  const Pack<double> zero(0.0);
  Mask<double> exact = zero == zero;
  for (std::size_t k = 0; k < count; k += kLanes) {
    const Pack<double> value = load(values + k);
    const Pack<double> next = sum + value;
    const Pack<double> off = rounded_off(sum, value, next);
    const Pack<double> next_left = left + off;
    exact = exact & (rounded_off(left, off, next_left) == zero);
    sum = next;
    left = next_left;
  }
  if (any(!exact)) return 0;
  store(to, sum);
  store(to + kLanes, left);
  return 2 * kLanes;
}

/// Adds `count` numbers, in whole packs.
template <class Real>
HOOKE_HD void add_parts(const Real* values, std::size_t count, ExactParts& parts) {
  constexpr std::size_t kFew = 8 * Pack<Real>::kLanes;
  const auto add = [&](const Real* from, std::size_t n) {
    const std::size_t added = sum_lanes(from, n, parts.values + parts.count);
    parts.count += added;
    return added > 0;
  };
  if (add(values, count)) return;
  for (std::size_t few; count > 0; values += few, count -= few) {
    few = count < kFew ? count : kFew;
    if (add(values, few)) continue;
    for (std::size_t k = 0; k < few; ++k) parts.values[parts.count++] = static_cast<double>(values[k]);
  }
}

}  // namespace hooke::HOOKE_ISA
