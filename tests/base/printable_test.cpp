// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/base/printable.h"

#include <gtest/gtest.h>

namespace hooke {
namespace {

TEST(Printable, LeavesOrdinaryTextAsItIs) {
  EXPECT_EQ(printable("water 3 \"a\\b\""), "water 3 \"a\\b\"");
  EXPECT_EQ(printable("Öl, \xe6\xb0\xb4, \xf0\x9f\x92\xa7"), "Öl, \xe6\xb0\xb4, \xf0\x9f\x92\xa7");
  EXPECT_EQ(printable(""), "");
}

TEST(Printable, LetsNothingSteerATerminal) {
  EXPECT_EQ(printable("\x1b[31mred\a\x7f"), "\\u001b[31mred\\u0007\\u007f");
  EXPECT_EQ(printable(std::string_view("a\0b\n\t", 5)), "a\\u0000b\\n\\t");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\u009b31m")
      << "a control sequence in one character";
  EXPECT_EQ(printable("\xe2\x80\xae"
                      "gnp"),
            "\\u202egnp")
      << "from right to left";
}

TEST(Printable, ReplacesWhatIsNotUtf8) {
  const std::string mark = "\xef\xbf\xbd";
  EXPECT_EQ(printable("a\xff"), "a" + mark);
  EXPECT_EQ(printable("\xc3"), mark) << "cut";
  EXPECT_EQ(printable("\xc0\xaf"), mark + mark) << "overlong";
  EXPECT_EQ(printable("\xed\xa0\x80"), mark + mark + mark) << "half of a pair";
}

TEST(Printable, CutsBetweenCharacters) {
  EXPECT_EQ(printable("abcdef", 3), "abc...");
  EXPECT_EQ(printable("abc", 3), "abc");
  EXPECT_EQ(printable("ab\xc3\xb6", 3), "ab...");
  EXPECT_EQ(printable(std::string(1000, 'x')).size(), 203U);
}

TEST(PathStep, QuotesWhatIsNoPlainKey) {
  EXPECT_EQ(path_step("radius"), ".radius");
  EXPECT_EQ(path_step("\xc3\xb6l"), ".\xc3\xb6l");
  EXPECT_EQ(path_step("salt water"), "[\"salt water\"]");
  EXPECT_EQ(path_step(""), "[\"\"]");
  EXPECT_EQ(path_step("say \"a\\b\""), "[\"say \\\"a\\\\b\\\"\"]");
  EXPECT_EQ(path_step("\x1b]0;t\a"), "[\"\\u001b]0;t\\u0007\"]");
}

}  // namespace
}  // namespace hooke
