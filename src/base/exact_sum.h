// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace hooke {

/// A sum of doubles without any rounding: the result depends on which values were added, never on
/// their order, so threads, restarts and storage orders all report the same bits. A fixed-point
/// number that spans the whole range of double (Kulisch, "Computer Arithmetic and Validity", 2008).
class ExactSum {
 public:
  /// Adds a finite value. NaN and infinities make the whole sum NaN.
  void add(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const auto exponent = static_cast<unsigned>((bits >> 52U) & 0x7ffU);
    const std::uint64_t fraction = bits & 0xfffffffffffffU;
    if (exponent == 0 && fraction == 0) return;
    if (exponent == 0x7ffU) {
      not_finite_ = true;
      return;
    }
    // value = mantissa * 2^(position - 1074); position 0 for subnormal numbers
    const unsigned position = exponent == 0 ? 0 : exponent - 1;
    const std::uint64_t mantissa = exponent == 0 ? fraction : fraction | (std::uint64_t{1} << 52U);
    const unsigned limb = position / 32;
    const unsigned shift = position % 32;
    const std::uint64_t low = (mantissa & 0xffffffffU) << shift;
    const std::uint64_t high = (mantissa >> 32U) << shift;
    const auto a = static_cast<std::int64_t>(low & 0xffffffffU);
    const auto b = static_cast<std::int64_t>((low >> 32U) + (high & 0xffffffffU));
    const auto c = static_cast<std::int64_t>(high >> 32U);
    if ((bits >> 63U) != 0) {
      limbs_[limb] -= a;
      limbs_[limb + 1] -= b;
      limbs_[limb + 2] -= c;
    } else {
      limbs_[limb] += a;
      limbs_[limb + 1] += b;
      limbs_[limb + 2] += c;
    }
    if (++pending_ == kMaxPending) carry();
  }

  /// Adds `count` values.
  void add(const double* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) add(values[i]);
  }

  /// Adds `count` values, some at a time: floats of not too different size have a sum that a double holds exactly.
  void add(const float* values, std::size_t count) {
    constexpr std::size_t kAtOnce = 64;
    for (; count > kAtOnce; count -= kAtOnce, values += kAtOnce) add_few(values, kAtOnce);
    add_few(values, count);
  }

  /// Adds another sum, again without rounding.
  void add(const ExactSum& other) {
    ExactSum rest = other;
    rest.carry();
    carry();
    for (std::size_t i = 0; i < kLimbs; ++i) limbs_[i] += rest.limbs_[i];
    not_finite_ = not_finite_ || other.not_finite_;
    ++pending_;
  }

  /// The sum as a double, off by at most one unit in the last place.
  double value() const {
    if (not_finite_) return std::nan("");
    ExactSum magnitude = *this;
    magnitude.carry();
    const bool negative = magnitude.limbs_[kLimbs - 1] < 0;
    if (negative) {
      for (std::int64_t& limb : magnitude.limbs_) limb = -limb;
      magnitude.carry();
    }
    double sum = 0;
    int used = 0;
    for (std::size_t i = kLimbs; i-- > 0 && used < 4;) {
      if (magnitude.limbs_[i] == 0 && used == 0) continue;
      sum += std::ldexp(static_cast<double>(magnitude.limbs_[i]), static_cast<int>(32 * i) - 1074);
      ++used;
    }
    return negative ? -sum : sum;
  }

 private:
  // At most 64 values.
  void add_few(const float* values, std::size_t count) {
    // Whole multiples of the smallest one's unit, 24 bits long, 64 of them: 23 binary orders of size leave room.
    constexpr std::uint32_t kOrders = 23U << 23U, kExponent = 0xffU << 23U;
    std::uint32_t largest = 0, smallest = kExponent;
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t exponent = std::bit_cast<std::uint32_t>(values[i]) & kExponent;
      largest = std::max(largest, exponent);
      smallest = std::min(smallest, values[i] != 0 ? exponent : kExponent);
      sum += static_cast<double>(values[i]);
    }
    if (largest < kExponent && smallest > 0 && largest <= smallest + kOrders) return add(sum);
    for (std::size_t i = 0; i < count; ++i) add(static_cast<double>(values[i]));
  }

  static constexpr std::size_t kLimbs = 70;  // 2098 bits of double, two limbs of room for carries
  static constexpr std::uint32_t kMaxPending = 1U << 29U;

  // Brings every limb but the last into [0, 2^32).
  void carry() {
    std::int64_t over = 0;
    for (std::size_t i = 0; i + 1 < kLimbs; ++i) {
      const std::int64_t limb = limbs_[i] + over;
      over = limb >> 32;
      limbs_[i] = limb - (over << 32);
    }
    limbs_[kLimbs - 1] += over;
    pending_ = 0;
  }

  std::array<std::int64_t, kLimbs> limbs_{};
  std::uint32_t pending_ = 0;
  bool not_finite_ = false;
};

}  // namespace hooke
