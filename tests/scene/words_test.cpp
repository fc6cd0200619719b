// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/words.h"

#include <gtest/gtest.h>

#include <string>

namespace hooke {
namespace {

TEST(Words, AreWhatStandsBetweenBlanks) {
  std::vector<std::string_view> words{"old"};
  scene::split_words(" \ta  bc\td\r", words);
  EXPECT_EQ(words, (std::vector<std::string_view>{"a", "bc", "d"}));
  scene::split_words(" \t", words);
  EXPECT_TRUE(words.empty());
  EXPECT_EQ(scene::trimmed(" \t a b \r"), "a b");
  EXPECT_EQ(scene::trimmed("\r "), "");
}

TEST(Words, NumbersAreWholeAndFinite) {
  double value = 0;
  EXPECT_TRUE(scene::read_number("+1.5e-3", value));
  EXPECT_EQ(value, 1.5e-3);
  EXPECT_TRUE(scene::read_number("-1e-999", value));
  EXPECT_EQ(value, 0);
  for (const char* bad : {"", "+", "-", "+-1", "1e999", "-1e999", "nan", "inf", "1 ", "0x1", "1,5", "1.5f"}) {
    EXPECT_FALSE(scene::read_number(bad, value)) << bad;
  }
}

TEST(Words, CountsAreWhole) {
  std::uint64_t value = 0;
  EXPECT_TRUE(scene::read_count("18446744073709551615", value));
  EXPECT_EQ(value, 18446744073709551615U);
  for (const char* bad : {"", "-1", "+1", "1.0", "18446744073709551616", "1 "})
    EXPECT_FALSE(scene::read_count(bad, value)) << bad;
}

}  // namespace
}  // namespace hooke
