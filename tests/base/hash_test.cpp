// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/base/hash.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>

namespace hooke {
namespace {

// The first outputs of SplitMix64 from state 0, as its authors publish them; mix64 adds the increment itself.
TEST(Mix64, IsSplitMix64) {
  constexpr std::uint64_t kIncrement = 0x9e3779b97f4a7c15U;
  EXPECT_EQ(mix64(0), 0xe220a8397b1dcdafU);
  EXPECT_EQ(mix64(kIncrement), 0x6e789e6aa1b965f4U);
  EXPECT_EQ(mix64(2 * kIncrement), 0x06c45d188009454fU);
}

TEST(Mix64, ChangesHalfOfTheBitsForEachInputBit) {
  for (std::uint64_t value : {0UL, 1UL, 0x3ff0000000000000UL, ~0UL}) {
    for (unsigned bit = 0; bit < 64; ++bit) {
      const int changed = std::popcount(mix64(value) ^ mix64(value ^ (std::uint64_t{1} << bit)));
      EXPECT_GT(changed, 12) << value << " bit " << bit;
      EXPECT_LT(changed, 52) << value << " bit " << bit;
    }
  }
}

TEST(Combine64, DependsOnOrderAndOnEveryValue) {
  const auto fold = [](std::initializer_list<std::uint64_t> values) {
    std::uint64_t hash = 0;
    for (const std::uint64_t v : values) hash = combine64(hash, v);
    return hash;
  };
  const std::set<std::uint64_t> hashes{fold({1, 2, 3}), fold({1, 3, 2}),    fold({3, 2, 1}),
                                       fold({1, 2}),    fold({0, 1, 2, 3}), fold({1, 2, 3, 0})};
  EXPECT_EQ(hashes.size(), 6U);
}

}  // namespace
}  // namespace hooke
