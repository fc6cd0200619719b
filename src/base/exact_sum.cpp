// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/base/exact_sum.h"

#include <cmath>

namespace hooke {

namespace {

// Calls visit(part) for each of sum.parts().
template <class Visit>
void for_each_part(const ExactSum& sum, const Visit& visit) {
  ExactSum rest = sum;
  for (double part = rest.value(); part != 0; part = rest.value()) {
    if (!std::isfinite(part)) return visit(std::nan(""));
    visit(part);
    rest.add(-part);
  }
}

}  // namespace

void ExactSum::add(const ExactSum& other) {
  if (other.is_zero()) return;
  add(other.sum_);
  add(other.left_);
  not_finite_ = not_finite_ || other.not_finite_;
  if (other.pending_ == 0) return;
  const auto add_limbs = [this](const ExactSum& sum) {
    for (std::size_t i = 0; i < kLimbs; ++i) limbs_[i] += sum.limbs_[i];
    pending_ += sum.pending_;
  };
  if (pending_ + other.pending_ < kMaxPending) return add_limbs(other);
  ExactSum carried = other;
  carried.carry();
  carry();
  add_limbs(carried);
}

void ExactSum::add_product(double a, double b) {
  const double product = a * b;
  add(product);
  add(std::fma(a, b, -product));
}

void ExactSum::add_scaled(const ExactSum& other, double factor) {
  for_each_part(other, [&](double part) { add_product(part, factor); });
}

std::vector<double> ExactSum::parts() const {
  std::vector<double> parts;
  for_each_part(*this, [&](double part) { parts.push_back(part); });
  return parts;
}

bool operator==(const ExactSum& a, const ExactSum& b) {
  ExactSum x = a, y = b;
  x.normalise();
  y.normalise();
  return x.not_finite_ == y.not_finite_ && (x.not_finite_ || x.limbs_ == y.limbs_);
}

double ExactSum::value() const {
  if (is_zero()) return 0;  // most often what no one has added to
  ExactSum magnitude = *this;
  magnitude.normalise();
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

// Leaves the one way to write the sum with limbs alone.
void ExactSum::normalise() {
  put_down();
  carry();
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
  pending_ = 1;
}

}  // namespace hooke
