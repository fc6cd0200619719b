// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace hooke {
namespace {

using Words = std::array<std::uint32_t, 4>;

// Random123, tests/kat_vectors: "philox4x32 10".
TEST(Philox, GivesThePublishedVectors) {
  constexpr std::uint32_t kOnes = 0xffffffffU;
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5U, 0xe169c58dU, 0xbc57ac4cU, 0x9b00dbd8U}));
  EXPECT_EQ(philox4x32({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}),
            (Words{0x408f276dU, 0x41c83b0eU, 0xa20bc7c6U, 0x6d5451fdU}));
  EXPECT_EQ(philox4x32({0x243f6a88U, 0x85a308d3U, 0x13198a2eU, 0x03707344U}, {0xa4093822U, 0x299f31d0U}),
            (Words{0xd16cfe09U, 0x94fdccebU, 0x5001e420U, 0x24126ea1U}));
}

TEST(Uniform4, IsThePhiloxOfItsArguments) {
  constexpr std::uint64_t kSeed = 0x299f31d0a4093822U;
  constexpr std::uint64_t kIndex = 0x85a308d3243f6a88U;
  const auto u = uniform4(kSeed, kIndex, 0x13198a2eU, 0x03707344U);
  EXPECT_EQ(u[0], 0xd16cfe09U / 4294967296.0);
  EXPECT_EQ(u[3], 0x24126ea1U / 4294967296.0);
}

TEST(Uniform4, FillsTheUnitInterval) {
  constexpr int kCount = 100'000;
  double sum = 0;
  double square = 0;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    for (const double u : uniform4(7, i, 0)) {
      ASSERT_GE(u, 0);
      ASSERT_LT(u, 1);
      sum += u;
      square += u * u;
    }
  }
  // Five standard errors of the mean (1/sqrt(12 n)) and of the mean square (2/sqrt(45 n)).
  const double n = 4.0 * kCount;
  EXPECT_NEAR(sum / n, 0.5, 5 * 0.2887 / std::sqrt(n));
  EXPECT_NEAR(square / n, 1.0 / 3, 5 * 0.2981 / std::sqrt(n));
}

TEST(Uniform4, DiffersByEveryArgument) {
  const std::set<double> firsts{uniform4(1, 1, 1, 1)[0],
                                uniform4(2, 1, 1, 1)[0],
                                uniform4(1, 2, 1, 1)[0],
                                uniform4(1, 1, 2, 1)[0],
                                uniform4(1, 1, 1, 2)[0],
                                uniform4(1 + (1UL << 32U), 1, 1, 1)[0],
                                uniform4(1, 1 + (1UL << 32U), 1, 1)[0]};
  EXPECT_EQ(firsts.size(), 7U);
}

}  // namespace
}  // namespace hooke
