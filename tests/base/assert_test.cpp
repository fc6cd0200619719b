// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/base/assert.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>

#include "base/assert_off.h"
#include "hooke/base/vec3.h"
#include "support/assertions.h"

namespace hooke {
namespace {

struct Failure {
  std::string expression, file, function, values;
  int line = 0;
};

// The values' text that the handler gets when an assertion with these names and values fails.
template <class... Values>
std::string text_of(const char* names, const Values&... values) {
  static std::string text;
  const AssertHandler before = set_assert_handler([](const AssertionFailure& failure) {
    text = failure.values;
    throw 0;
  });
  try {
    detail::assertion_failed({"x", names, "a.cpp", 1, "f"}, {values...});
  } catch (int) {}
  set_assert_handler(before);
  return text;
}

TEST(Assert, ValuesAreShownBesideTheirNames) {
  const std::size_t index = 7, count = 5;
  EXPECT_EQ(text_of("index, count", index, count), "index = 7, count = 5");
  EXPECT_EQ(text_of(""), "");
}

TEST(Assert, ShowsNumbersInFewestDigits) {
  EXPECT_EQ(text_of("a, b, c", 0.1, 0.1F, -3), "a = 0.1, b = 0.1, c = -3");
  EXPECT_EQ(text_of("a", std::numeric_limits<std::uint64_t>::max()), "a = 18446744073709551615");
  EXPECT_EQ(text_of("a", std::numeric_limits<std::int64_t>::min()), "a = -9223372036854775808");
  EXPECT_EQ(text_of("a, b", std::numeric_limits<double>::infinity(), std::numeric_limits<float>::quiet_NaN()),
            "a = inf, b = nan");
}

TEST(Assert, ShowsWhateverPreconditionsAreAbout) {
  enum class Colour { red, green };
  EXPECT_EQ(text_of("a, b", true, Colour::green), "a = true, b = 1");
  EXPECT_EQ(text_of("x", Vec3d{0.1, 2, -3}), "x = (0.1, 2, -3)");
  EXPECT_EQ(text_of("x", Vec3f{0.1F, 2, -3}), "x = (0.1, 2, -3)");
  EXPECT_EQ(text_of("a, b", "cubic", std::string("silk")), "a = \"cubic\", b = \"silk\"");
  EXPECT_EQ(text_of("a", static_cast<const char*>(nullptr)), "a = null");
  EXPECT_EQ(text_of("a, b", nullptr, reinterpret_cast<const int*>(0xbeef)), "a = null, b = 0xbeef");
}

TEST(Assert, NamesAreApartAtCommasOutsideOfBracketsAndQuotes) {
  EXPECT_EQ(text_of("f(a, b), c[{1, 2}], \"x, \\\",\", ','", 1, 2, 3, 4),
            "f(a, b) = 1, c[{1, 2}] = 2, \"x, \\\",\" = 3, ',' = 4");
}

TEST(Assert, CutsOffLongTexts) {
  const std::string text = text_of("name, other", std::string(5000, 'x'), 1);
  EXPECT_GT(text.size(), 500U);
  EXPECT_LT(text.size(), 5000U);
}

TEST(Assert, HandlerGetsExpressionPlaceAndValues) {
  if (HOOKE_ASSERTIONS == 0) GTEST_SKIP() << "built without assertions";
  static Failure seen;
  const AssertHandler before = set_assert_handler([](const AssertionFailure& failure) {
    seen = {failure.expression, failure.file, failure.function, std::string(failure.values), failure.line};
    throw 0;
  });
  const int index = 7, count = 5;
  const int line = __LINE__ + 1;
  EXPECT_THROW(HOOKE_ASSERT(index < count, index, count), int);
  set_assert_handler(before);
  EXPECT_EQ(seen.expression, "index < count");
  EXPECT_EQ(seen.values, "index = 7, count = 5");
  EXPECT_NE(seen.file.find("assert_test.cpp"), std::string::npos) << seen.file;
  EXPECT_EQ(seen.function, "TestBody");
  EXPECT_EQ(seen.line, line);
}

TEST(Assert, WhatHoldsDoesNothing) {
  int evaluated = 0;
  EXPECT_EQ(test::failed_assertion([&] { HOOKE_ASSERT(++evaluated == 1); }), "");
  EXPECT_EQ(evaluated, HOOKE_ASSERTIONS);
}

TEST(Assert, IsAStatement) {
  const bool yes = evaluations_without_assertions() == 0;
  if (yes)
    HOOKE_ASSERT(yes);
  else
    HOOKE_ASSERT(!yes);
}

TEST(Assert, ReplacingTheHandlerReturnsTheOneBefore) {
  const AssertHandler own = [](const AssertionFailure&) {};
  const AssertHandler standard = set_assert_handler(own);
  EXPECT_EQ(set_assert_handler(nullptr), own);
  EXPECT_EQ(set_assert_handler(standard), standard);
}

TEST(Assert, WithoutAssertionsNothingIsEvaluated) { EXPECT_EQ(evaluations_without_assertions(), 0); }

TEST(AssertDeathTest, DefaultHandlerWritesOneLineAndAborts) {
  if (HOOKE_ASSERTIONS == 0) GTEST_SKIP() << "built without assertions";
  const int index = 7, count = 5;
  EXPECT_DEATH(HOOKE_ASSERT(index < count, index, count),
               "^[^\n]*assert_test.cpp:[0-9]+: TestBody: assertion failed: index < count, with index = 7, count = 5\n");
  EXPECT_DEATH(HOOKE_ASSERT(index < count), "TestBody: assertion failed: index < count\n");
}

TEST(AssertDeathTest, NothingFollowsAHandlerThatReturns) {
  if (HOOKE_ASSERTIONS == 0) GTEST_SKIP() << "built without assertions";
  EXPECT_EXIT(
      {
        set_assert_handler([](const AssertionFailure&) {});
        HOOKE_ASSERT(evaluations_without_assertions() > 0);
        std::_Exit(0);
      },
      ::testing::KilledBySignal(SIGABRT), "");
}

}  // namespace
}  // namespace hooke
