// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <mutex>
#include <string>

#include "hooke/base/assert.h"

/// Expects that an assertion fails in `statement`, whose text, as in "index < count; index = 7, count = 5", has `part`
/// in it. The handler of the tests throws, so a statement must be able to let exceptions pass or turn them into errors:
/// one that does neither (noexcept) wants EXPECT_DEATH. Skips the test where assertions are off.
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

/// The text of the first assertion that fails in statement(); empty where none does.
template <class Statement>
std::string failed_assertion(const Statement& statement) {
  static std::mutex mutex;  // around the text: other threads may fail, too
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
