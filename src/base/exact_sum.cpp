// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/base/exact_sum.h"

#include <bit>
#include <cmath>

namespace hooke {

void ExactSum::add(const ExactSum& other) {
  add(other.sum_);
  add(other.left_);
  if (other.pending_ == 0 && !other.not_finite_) return;
  ExactSum rest = other;
  rest.carry();
  carry();
  for (std::size_t i = 0; i < kLimbs; ++i) limbs_[i] += rest.limbs_[i];
  not_finite_ = not_finite_ || rest.not_finite_;
  ++pending_;
}

double ExactSum::value() const {
  ExactSum magnitude = *this;
  magnitude.put_down();
  magnitude.carry();
  if (magnitude.not_finite_) return std::nan("");
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

// Moves what the two doubles hold to the limbs, and adds another value there.
void ExactSum::put_down(double value) {
  add_to_limbs(sum_);
  add_to_limbs(left_);
  add_to_limbs(value);
  sum_ = left_ = 0;
}

void ExactSum::add_to_limbs(double value) {
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

// Brings every limb but the last into [0, 2^32).
void ExactSum::carry() {
  std::int64_t over = 0;
  for (std::size_t i = 0; i + 1 < kLimbs; ++i) {
    const std::int64_t limb = limbs_[i] + over;
    over = limb >> 32;
    limbs_[i] = limb - (over << 32);
  }
  limbs_[kLimbs - 1] += over;
  pending_ = 0;
}

}  // namespace hooke
