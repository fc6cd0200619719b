// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/base/exact_sum.h"

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

// Brings every limb except the last into [0, 2^32).
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
