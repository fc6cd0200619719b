// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/base/format.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>

#include "hooke/base/random.h"

namespace hooke {
namespace {

TEST(Formatted, FillsPlacesInTheirOrder) {
  EXPECT_EQ(formatted("no place"), "no place");
  EXPECT_EQ(formatted("{} and {}", "one", std::string("two")), "one and two");
  EXPECT_EQ(formatted("{}{}", -3, std::uint64_t{18446744073709551615U}), "-318446744073709551615");
  EXPECT_EQ(formatted("({}, {:.3g}) m", 0.1, 1234.5), "(0.1, 1.23e+03) m");
}

// The same texts as those of the library that the other libraries of Hooke use.
TEST(Formatted, ShowsNumbersAsFmtDoes) {
  const auto expect_same = [](auto value) {
    EXPECT_EQ(formatted("{}", value), fmt::format("{}", value));
    if constexpr (std::is_floating_point_v<decltype(value)>) {
      EXPECT_EQ(formatted("{:.3g}", value), fmt::format("{:.3g}", value));
      EXPECT_EQ(formatted("{:.6g}", value), fmt::format("{:.6g}", value));
      EXPECT_EQ(formatted("{:.17g}", value), fmt::format("{:.17g}", value));
    }
  };
  for (const double value : {0.0, -0.0, 1.0, 100000.0, 1e15, 123456789012345678.0, 1e16, 1e-4, 1e-5, 0.1, 1e22, 5e-324,
                             std::numeric_limits<double>::max(), std::numeric_limits<double>::infinity()}) {
    expect_same(value);
    expect_same(-value);
    expect_same(static_cast<float>(value));
  }
  for (std::uint64_t i = 0; i < 2000; ++i) {
    // Any bits: all exponents are as frequent.
    const std::uint64_t bits = (i + 1) * 0x9e3779b97f4a7c15U;
    const auto number = std::bit_cast<double>(bits);
    if (number != number) continue;  // the sign of a NaN is shown by one of them only
    expect_same(number);
    expect_same(uniform4(2, i, 0)[0]);
    expect_same(static_cast<std::int64_t>(bits));
  }
}

}  // namespace
}  // namespace hooke
