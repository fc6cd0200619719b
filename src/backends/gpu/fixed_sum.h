// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "hooke/backends/gpu/device.h"
#include "hooke/backends/gpu/warp.h"
#include "hooke/base/exact_sum.h"

namespace hooke::gpu {

/// How the range of a type of numbers is cut into digits of a fixed-point number: digit k counts in units of
/// 2^(kLowest + k kBits).
template <class Real>
struct Digits;
template <>
struct Digits<float> {
  static constexpr int kBits = 24, kCount = 13, kLowest = -149;
};
template <>
struct Digits<double> {
  static constexpr int kBits = 32, kCount = 68, kLowest = -1074;
};

/// An exact sum that many threads add to: whole numbers, so that no order matters. Terms in the sum's window go, a warp
/// at a time, to two numbers; all others to digits that span all finite numbers. Zeros all over are an empty sum.
template <class Real>
struct FixedSum {
  unsigned long long window[2];  // of terms in units of the window's lowest bit: their lower 32 bits, and what is above
  unsigned long long digits[Digits<Real>::kCount];
  std::uint32_t largest;  // bits of the largest |term|, single precision
  std::uint32_t not_finite;  // 1: a term was infinite or NaN
};

/// Sums that many threads add to, each in copies so that threads rarely meet: those of copy k follow those of copy k
/// - 1.
template <class Real>
struct SumCopies {
  static constexpr std::uint32_t kCopies = 32;

  FixedSum<Real>* first = nullptr;
  std::uint32_t count = 0;  // sums

  /// Those that item i adds to.
  HOOKE_HD FixedSum<Real>* of_item(std::uint32_t i) const { return first + i / 256 % kCopies * count; }
};

/// Adds all copies to the first ones. Items are the sums' words.
template <class Real>
struct AddCopies {
  static constexpr std::uint32_t kWords = 2 + Digits<Real>::kCount + 1;  // of a sum; the last are two short ones

  SumCopies<Real> sums;

  std::uint32_t items() const { return kWords * sums.count; }

  HOOKE_HD void operator()(std::uint32_t item) const {
    const std::uint32_t sum = item / kWords, word = item % kWords;
    FixedSum<Real>& total = sums.first[sum];
    for (std::uint32_t copy = 1; copy < SumCopies<Real>::kCopies; ++copy) {
      const FixedSum<Real>& part = sums.first[copy * sums.count + sum];
      if (word < 2) {
        total.window[word] += part.window[word];
      } else if (word + 1 < kWords) {
        total.digits[word - 2] += part.digits[word - 2];
      } else {
        total.largest = part.largest > total.largest ? part.largest : total.largest;
        total.not_finite |= part.not_finite;
      }
    }
  }
};

/// Which floats are whole numbers of 54 bits in units of 2^low: those of sizes from `least` on and below `most`. A warp
/// adds up 32 of them in 64 bits; 2^31 warps add up the lower and the upper 32 bits of these in 64 each.
struct SumWindow {
  static constexpr int kBits = 54;
  float scale = 1, least = 0x1p23F, most = 0x1p54F;
  int low = 0;

  /// With room for terms 16 times as large as this one, given by the bits of its size.
  static SumWindow around(std::uint32_t largest) {
    constexpr int kFloor = -126, kCeiling = 126 - kBits;
    const int exponent = static_cast<int>(largest >> 23U) - 126;  // the size is below 2^exponent
    const int wanted = exponent + 4 - kBits;
    SumWindow window;
    window.low = wanted < kFloor ? kFloor : wanted > kCeiling ? kCeiling : wanted;
    window.scale = std::ldexp(1.0F, -window.low);
    window.least = std::ldexp(1.0F, window.low + 23);
    window.most = std::ldexp(1.0F, window.low + kBits);
    return window;
  }
};

HOOKE_HD std::uint64_t fraction_of(float a) { return __builtin_bit_cast(std::uint32_t, a) & 0x7fffffU; }
HOOKE_HD std::uint64_t fraction_of(double a) { return __builtin_bit_cast(std::uint64_t, a) & 0xfffffffffffffU; }
HOOKE_HD unsigned exponent_of(float a) { return __builtin_bit_cast(std::uint32_t, a) >> 23U & 0xffU; }
HOOKE_HD unsigned exponent_of(double a) {
  return static_cast<unsigned>(__builtin_bit_cast(std::uint64_t, a) >> 52U & 0x7ffU);
}

/// Adds any number to the digits.
template <class Real>
HOOKE_HD void add_to_digits(FixedSum<Real>& sum, Real term) {
  constexpr unsigned kFraction = sizeof(Real) == 4 ? 23 : 52, kTop = sizeof(Real) == 4 ? 0xff : 0x7ff;
  constexpr unsigned kBits = Digits<Real>::kBits;
  constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;
  const unsigned exponent = exponent_of(term);
  if (exponent == kTop) return raise_to(&sum.not_finite, 1);
  std::uint64_t mantissa = fraction_of(term);
  if (exponent != 0) mantissa |= std::uint64_t{1} << kFraction;
  // term = +- mantissa 2^(kLowest + at)
  const unsigned at = exponent == 0 ? 0 : exponent - 1, shift = at % kBits;
  unsigned digit = at / kBits;
  std::uint64_t part = mantissa << shift & kMask, rest = mantissa >> (kBits - shift);
  for (;;) {
    if (part != 0) add_to(&sum.digits[digit], term < Real(0) ? 0 - part : part);
    if (rest == 0) return;
    ++digit;
    part = rest & kMask;
    rest >>= kBits;
  }
}

/// Adds one term an item; all items of a warp call it together.
HOOKE_HD void add_term(FixedSum<float>& sum, const SumWindow& window, float term) {
  const float size = __builtin_fabsf(term);
  const bool fits = size == 0.0F || (size >= window.least && size < window.most);
  const long long whole = fits ? static_cast<long long>(term * window.scale) : 0;
  if (!fits) add_to_digits(sum, term);
  raise_by_warp(&sum.largest, __builtin_bit_cast(std::uint32_t, size));
#if defined(__CUDA_ARCH__)
  // Parts of 26, 26 and 12 bits: 32 of them fit 32 bits each.
  const unsigned low = __reduce_add_sync(~0U, static_cast<unsigned>(whole) & 0x3ffffffU);
  const unsigned middle = __reduce_add_sync(~0U, static_cast<unsigned>(whole >> 26) & 0x3ffffffU);
  const int high = __reduce_add_sync(~0U, static_cast<int>(whole >> 52));
  if ((threadIdx.x & (kWarp - 1)) != 0) return;
  const unsigned long long all = low + (static_cast<unsigned long long>(middle) << 26U) +
                                 (static_cast<unsigned long long>(static_cast<long long>(high)) << 52U);
#else
  const auto all = static_cast<unsigned long long>(whole);
#endif
  if (all == 0) return;
  add_to(&sum.window[0], all & 0xffffffffU);
  add_to(&sum.window[1], static_cast<unsigned long long>(static_cast<long long>(all) >> 32));
}
HOOKE_HD void add_term(FixedSum<double>& sum, const SumWindow&, double term) {
  if (term != 0.0) add_to_digits(sum, term);
}

/// Adds what the device has summed to the host's exact sum.
template <class Real>
void add_fixed(const FixedSum<Real>& sum, const SumWindow& window, ExactSum& to) {
  const auto add = [&](unsigned long long whole, int exponent) {  // a number of 64 bits is two doubles
    if (whole == 0) return;
    const auto all = static_cast<long long>(whole);
    // Both parts have the sign of the whole: the upper part of a small negative number in the highest digit is then
    // zero, where a floor of -1 would be an infinity in a double.
    const long long high = all / (1LL << 32), low = all % (1LL << 32);
    to.add(std::ldexp(static_cast<double>(high), exponent + 32));
    to.add(std::ldexp(static_cast<double>(low), exponent));
  };
  if (sum.not_finite != 0) to.add(std::nan(""));
  add(sum.window[0], window.low);
  add(sum.window[1], window.low + 32);
  for (int k = 0; k < Digits<Real>::kCount; ++k) add(sum.digits[k], Digits<Real>::kLowest + k * Digits<Real>::kBits);
}

}  // namespace hooke::gpu
