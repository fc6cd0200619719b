// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/base/exact_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "hooke/base/random.h"

namespace hooke {
namespace {

using Limits = std::numeric_limits<double>;

double sum_of(const std::vector<double>& values) {
  ExactSum sum;
  for (const double v : values) sum.add(v);
  return sum.value();
}

// Numbers of either sign over `decades` powers of two around 2^`middle`.
std::vector<double> spread_numbers(std::size_t count, int middle, int powers, std::uint64_t seed) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto u = uniform4(seed, i, 0);
    values[i] = std::ldexp(u[0] - 0.5 + u[2] * 1e-9, middle + static_cast<int>((u[1] - 0.5) * powers));
  }
  return values;
}

void shuffle(std::vector<double>& values, std::uint64_t seed) {
  for (std::size_t i = values.size(); i > 1; --i) {
    const auto k = static_cast<std::size_t>(uniform4(seed, i, 1)[0] * static_cast<double>(i));
    std::swap(values[i - 1], values[k]);
  }
}

TEST(ExactSum, OfNothingIsZero) {
  EXPECT_EQ(ExactSum{}.value(), 0);
  EXPECT_EQ(sum_of({0.0, -0.0}), 0);
}

TEST(ExactSum, OfOneNumberIsThatNumber) {
  for (const double v : {1.0, -1.0, 0.1, -1.0 / 3, Limits::max(), Limits::lowest(), Limits::min(), Limits::denorm_min(),
                         -Limits::denorm_min(), 3 * Limits::denorm_min(), Limits::min() - Limits::denorm_min(), 0x1p-32,
                         0x1p31, 0x1.fffffffffffffp+52, 1e300, 1e-300}) {
    EXPECT_EQ(sum_of({v}), v);
  }
  for (const double v : spread_numbers(2000, 0, 2000, 1)) EXPECT_EQ(sum_of({v}), v);
}

TEST(ExactSum, LosesNothingToCancellation) {
  EXPECT_EQ(sum_of({1e300, 1, -1e300}), 1);
  EXPECT_EQ(sum_of({1, 1e-300, -1}), 1e-300);
  EXPECT_EQ(sum_of({Limits::max(), Limits::denorm_min(), Limits::lowest()}), Limits::denorm_min());
  EXPECT_EQ(sum_of({Limits::max(), Limits::max(), Limits::lowest(), Limits::lowest()}), 0);
  EXPECT_EQ(sum_of({0.1, 0.2, -0.3}), 0x1p-55);  // 0.1 + 0.2 - 0.3 of the doubles nearest to them, exactly
}

TEST(ExactSum, OfWholeNumbersIsExact) {
  ExactSum sum;
  for (int i = 1; i <= 100'000; ++i) {
    sum.add(i);
    sum.add(-0.5 * i);
  }
  EXPECT_EQ(sum.value(), 0.5 * 100'000.0 * 100'001.0 / 2);
}

TEST(ExactSum, OfSubnormalsIsExact) {
  ExactSum sum;
  for (int i = 0; i < 1000; ++i) sum.add(Limits::denorm_min());
  EXPECT_EQ(sum.value(), 1000 * Limits::denorm_min());
  for (int i = 0; i < 1001; ++i) sum.add(-Limits::denorm_min());
  EXPECT_EQ(sum.value(), -Limits::denorm_min());
}

// On x86 a long double holds 64 bits: the sum of a few thousand 53-bit numbers of one size is exact in it.
TEST(ExactSum, AgreesWithExtendedPrecision) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<double> values(2000);
    long double expected = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = uniform4(seed, i, 0)[0] - 0.5;
      expected += values[i];
    }
    EXPECT_DOUBLE_EQ(sum_of(values), static_cast<double>(expected));
  }
}

TEST(ExactSum, HasTheSameBitsInAnyOrder) {
  for (const int powers : {10, 300, 1900}) {
    std::vector<double> values = spread_numbers(3000, 0, powers, 3);
    const double expected = sum_of(values);
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      shuffle(values, seed);
      EXPECT_EQ(sum_of(values), expected);
    }
    std::sort(values.begin(), values.end());
    EXPECT_EQ(sum_of(values), expected);
  }
}

TEST(ExactSum, HasTheSameBitsHoweverItIsSplit) {
  const std::vector<double> values = spread_numbers(3000, 0, 1500, 4);
  const double expected = sum_of(values);
  for (const std::size_t parts : {2UL, 7UL, 300UL, 3000UL}) {
    std::vector<ExactSum> sums(parts);
    for (std::size_t i = 0; i < values.size(); ++i) sums[(i * 31) % parts].add(values[i]);
    ExactSum total;
    for (std::size_t k = parts; k-- > 0;) total.add(sums[k]);
    EXPECT_EQ(total.value(), expected);
  }
}

TEST(ExactSum, IsOffByOneUnitInTheLastPlaceAtMost) {
  // The sum of numbers and all their negatives but one is known, whatever the numbers are.
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    std::vector<double> values = spread_numbers(400, 0, 1500, seed);
    const double big = values[0];
    const double small = std::ldexp(big, -40);
    std::vector<double> both{big, small};
    for (std::size_t i = 1; i < values.size(); ++i) both.insert(both.end(), {values[i], -values[i]});
    shuffle(both, seed);
    const double expected = big + small;
    const double sum = sum_of(both);
    EXPECT_LE(std::abs(sum - expected), std::abs(std::nextafter(expected, INFINITY) - expected));
  }
}

TEST(ExactSum, IsOddInItsNumbers) {
  std::vector<double> values = spread_numbers(1000, 0, 1000, 9);
  const double sum = sum_of(values);
  for (double& v : values) v = -v;
  EXPECT_EQ(sum_of(values), -sum);
}

TEST(ExactSum, OfWhatIsNotFiniteIsNaN) {
  EXPECT_TRUE(std::isnan(sum_of({1, INFINITY})));
  EXPECT_TRUE(std::isnan(sum_of({INFINITY, -INFINITY})));
  EXPECT_TRUE(std::isnan(sum_of({1, std::nan(""), 2})));
  ExactSum part;
  part.add(INFINITY);
  ExactSum total;
  total.add(1);
  total.add(part);
  EXPECT_TRUE(std::isnan(total.value()));
}

TEST(ExactSum, BeyondTheLargestNumberIsInfinite) {
  EXPECT_EQ(sum_of({Limits::max(), Limits::max()}), INFINITY);
  EXPECT_EQ(sum_of({Limits::lowest(), Limits::lowest()}), -INFINITY);
}

// Floats of either sign and every size, with zeros and subnormal numbers.
std::vector<float> all_kinds_of_floats(std::size_t count) {
  std::vector<float> values = {0.0F, -0.0F, std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::max(),
                               -std::numeric_limits<float>::min()};
  for (const double v : spread_numbers(count, 0, 240, 7)) values.push_back(static_cast<float>(v));
  return values;
}

TEST(ExactSum, OfManyFloatsIsTheSumOfEach) {
  for (const double middle : {0.0, -120.0, 110.0}) {
    for (const int powers : {2, 20, 30, 60, 240}) {
      std::vector<float> values = powers == 240 ? all_kinds_of_floats(2'000) : std::vector<float>{};
      for (const double v : spread_numbers(2'000, static_cast<int>(middle), powers, 7)) {
        values.push_back(uniform4(8, values.size(), 0)[0] < 0.3 ? 0.0F : static_cast<float>(v));
      }
      for (std::size_t count = 0; count <= values.size(); count = 2 * count + 1) {
        ExactSum each, at_once;
        for (std::size_t i = 0; i < count; ++i) each.add(static_cast<double>(values[i]));
        at_once.add(values.data(), count);
        EXPECT_EQ(std::isnan(at_once.value()), std::isnan(each.value()));
        if (std::isnan(each.value())) break;
        EXPECT_EQ(at_once.value(), each.value()) << count;
        const double rounded = each.value();
        each.add(-rounded);
        at_once.add(-rounded);
        EXPECT_EQ(at_once.value(), each.value()) << "what a double can't show: " << count;
      }
    }
  }
}

TEST(ExactSum, OfFloatsThatAreNotFiniteIsNotANumber) {
  using Floats = std::numeric_limits<float>;
  for (const float bad : {Floats::quiet_NaN(), Floats::infinity(), -Floats::infinity()}) {
    std::vector<float> values(40, 1.0F);
    values[5] = bad;
    values[6] = -bad;
    ExactSum sum;
    sum.add(values.data(), values.size());
    EXPECT_TRUE(std::isnan(sum.value()));
  }
}

TEST(ExactSum, IsTheSumOfItsParts) {
  for (const int powers : {10, 200, 1500}) {
    std::vector<double> values = spread_numbers(2000, -3, powers, 5);
    ExactSum sum, shuffled, rebuilt;
    for (const double v : values) sum.add(v);
    shuffle(values, 9);
    for (const double v : values) shuffled.add(v);
    const std::vector<double> parts = sum.parts();
    EXPECT_EQ(parts, shuffled.parts()) << "the same ones in any order";
    EXPECT_EQ(parts.front(), sum.value());
    for (std::size_t k = 1; k < parts.size(); ++k) EXPECT_LT(std::abs(parts[k]), std::abs(parts[k - 1]));
    for (const double part : parts) rebuilt.add(part);
    EXPECT_EQ(rebuilt, sum);
    rebuilt.add(std::ldexp(1.0, -1074));
    EXPECT_FALSE(rebuilt == sum);
  }
  EXPECT_TRUE(ExactSum{}.parts().empty());
  ExactSum cancelled;
  for (const double v : {1e300, 1.0, -1e300, -1.0}) cancelled.add(v);
  EXPECT_TRUE(cancelled.parts().empty());
  EXPECT_EQ(cancelled, ExactSum{});
  ExactSum not_finite;
  not_finite.add(Limits::infinity());
  ASSERT_EQ(not_finite.parts().size(), 1U);
  EXPECT_TRUE(std::isnan(not_finite.parts().front()));
}

TEST(ExactSum, OfProductsKeepsWhatTheirRoundingLeaves) {
  const double a = 1 + 0x1p-30, b = 1 - 0x1p-30;  // a b = 1 - 2^-60
  ExactSum sum;
  sum.add_product(a, b);
  sum.add(-1);
  EXPECT_EQ(sum.value(), -0x1p-60);
  ExactSum thrice, added;
  thrice.add_product(3, 0.1);
  for (int i = 0; i < 3; ++i) added.add(0.1);
  EXPECT_EQ(thrice, added);
  ExactSum scaled;
  sum.add(1e10);
  scaled.add_scaled(sum, 0.1);
  sum = {};
  sum.add_product(1e10, 0.1);
  sum.add_product(-0x1p-60, 0.1);
  EXPECT_EQ(scaled, sum);
}

}  // namespace
}  // namespace hooke
