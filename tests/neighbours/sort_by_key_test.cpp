// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "hooke/base/hash.h"
#include "hooke/neighbours/cell_grid.h"

namespace hooke {
namespace {

void expect_sorted_like_the_standard_library(std::vector<std::uint64_t> keys) {
  std::vector<std::uint32_t> expected(keys.size());
  std::iota(expected.begin(), expected.end(), 0U);
  // Stable: by index where keys are equal.
  std::sort(expected.begin(), expected.end(),
            [&](std::uint32_t a, std::uint32_t b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
  std::vector<std::uint64_t> sorted = keys;
  std::sort(sorted.begin(), sorted.end());

  std::vector<std::uint32_t> order{1, 2, 3};  // earlier contents must not matter
  sort_by_key(keys, order);
  EXPECT_EQ(keys, sorted);
  EXPECT_EQ(order, expected);
}

std::vector<std::uint64_t> keys_of(std::size_t count, std::uint64_t (*key)(std::uint64_t)) {
  std::vector<std::uint64_t> keys(count);
  for (std::size_t i = 0; i < count; ++i) keys[i] = key(i);
  return keys;
}

TEST(SortByKey, HandlesFewKeys) {
  expect_sorted_like_the_standard_library({});
  expect_sorted_like_the_standard_library({7});
  expect_sorted_like_the_standard_library({7, 3});
  expect_sorted_like_the_standard_library({3, 3, 3, 3});
  expect_sorted_like_the_standard_library({~0UL, 0, 1UL << 63U, 1});
}

// More than one of the blocks that threads share out, and counts that are no multiple of a block.
TEST(SortByKey, IsStableAndRightForManyKeys) {
  for (const std::size_t count : {65'535UL, 65'537UL, 200'001UL}) {
    expect_sorted_like_the_standard_library(keys_of(count, [](std::uint64_t i) { return mix64(i); }));
    expect_sorted_like_the_standard_library(keys_of(count, [](std::uint64_t i) { return mix64(i) % 1000; }));
    expect_sorted_like_the_standard_library(keys_of(count, [](std::uint64_t i) { return mix64(i) % 3 << 40U; }));
    expect_sorted_like_the_standard_library(keys_of(count, [](std::uint64_t i) { return 1'000'000 - i; }));
    expect_sorted_like_the_standard_library(keys_of(count, [](std::uint64_t) { return std::uint64_t{42}; }));
  }
}

}  // namespace
}  // namespace hooke
