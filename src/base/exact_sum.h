// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace hooke {

/// A sum of floats without any rounding, for hot loops: one addition to the bin of the value's sign and exponent.
/// ExactSum takes it over.
class ExactFloatSum {
 public:
  /// Adds a value, at most 2^39 of them. NaN and infinities make the whole sum NaN.
  void add(float value) { add(value, bins_[0]); }

  /// Adds `count` values. Neighbours are often of a size: each goes to other bins than the one before, whose addition
  /// it would have to wait for.
  void add(const float* values, std::size_t count) {
    std::size_t i = 0;
    for (; i + kSets <= count; i += kSets) {
      for (std::size_t set = 0; set < kSets; ++set) add(values[i + set], bins_[set]);
    }
    for (; i < count; ++i) add(values[i]);
  }

 private:
  friend class ExactSum;
  static constexpr std::size_t kSets = 2, kBins = 512;
  using Bins = std::array<std::uint64_t, kBins>;  // by sign and exponent: sum of the mantissas

  static void add(float value, Bins& bins) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t bin = bits >> 23U;
    const std::uint32_t leading_one = (bin & 0xffU) != 0 ? 1U << 23U : 0;
    bins[bin] += (bits & 0x7fffffU) | leading_one;
  }

  std::array<Bins, kSets> bins_{};
};

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

  /// Adds another sum, again without rounding.
  void add(const ExactSum& other) {
    ExactSum rest = other;
    rest.carry();
    carry();
    for (std::size_t i = 0; i < kLimbs; ++i) limbs_[i] += rest.limbs_[i];
    not_finite_ = not_finite_ || other.not_finite_;
    ++pending_;
  }

  /// Adds a sum of floats, without rounding.
  void add(const ExactFloatSum& floats) {
    for (std::size_t bin = 0; bin < ExactFloatSum::kBins; ++bin) {
      std::uint64_t mantissas = 0;
      for (const auto& bins : floats.bins_) mantissas += bins[bin];
      if (mantissas == 0) continue;
      const int exponent = static_cast<int>(bin & 0xffU);
      if (exponent == 0xff) not_finite_ = true;
      const double unit = std::ldexp(bin < 256 ? 1.0 : -1.0, std::max(exponent, 1) - 150);
      add(unit * static_cast<double>(mantissas & 0xffffffffU));
      add(unit * 0x1p32 * static_cast<double>(mantissas >> 32U));
    }
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

/// The kind of exact sum that takes values of type Real.
template <class Real>
using ExactSumOf = std::conditional_t<std::is_same_v<Real, float>, ExactFloatSum, ExactSum>;

}  // namespace hooke
