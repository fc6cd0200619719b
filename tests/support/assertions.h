// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <mutex>
#include <string>

#include "hooke/base/assert.h"

/// Expects that an assertion fails in `statement` and that its text, such as "index < count; index = 7, count = 5",
/// contains `part`. The handler of the tests throws, so the statement must let exceptions pass or turn them into
/// errors; for a noexcept statement use EXPECT_DEATH. Skips the test where assertions are off.
#define EXPECT_ASSERTS(statement, part)                                                                         \
  do {                                                                                                          \
    if (HOOKE_ASSERTIONS == 0) GTEST_SKIP() << "built without assertions";                                      \
    const std::string asserted = ::hooke::test::failed_assertion([&] { statement; });                           \
    EXPECT_NE(asserted.find(part), std::string::npos) << (asserted.empty() ? "no assertion failed" : asserted); \
  } while (false)

namespace hooke::test {

struct FailedAssertion : std::exception {
  const char* what() const noexcept override { return "an assertion failed"; }
};

/// The text of the first assertion that fails in statement(); empty where none fails.
template <class Statement>
std::string failed_assertion(const Statement& statement) {
  static std::mutex mutex;  // guards the text: other threads may fail, too
  static std::string text;
  text.clear();
  const AssertHandler before = set_assert_handler([](const AssertionFailure& failure) {
    {
      const std::lock_guard lock(mutex);
      if (text.empty()) text.append(failure.expression).append("; ").append(failure.values);
    }
    throw FailedAssertion();
  });
  try {
    statement();
  } catch (const FailedAssertion&) {}
  set_assert_handler(before);
  return text;
}

}  // namespace hooke::test
