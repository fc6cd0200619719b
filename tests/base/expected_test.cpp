// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/base/expected.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "support/assertions.h"

namespace hooke {
namespace {

const Error kError{Error::Kind::io, {{"file", "is gone"}, {"", "and so is its folder"}}};

Expected<std::unique_ptr<int>> made(int value) {
  if (value < 0) return fail(kError);
  return std::make_unique<int>(value);
}

TEST(Expected, HoldsAValueOrAnError) {
  const auto good = made(7);
  ASSERT_TRUE(good);
  EXPECT_EQ(**good, 7);
  const auto bad = made(-1);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().kind, Error::Kind::io);
  EXPECT_EQ(bad.error().text(), "file: is gone\nand so is its folder");
}

TEST(Expected, MovesItsValueOut) {
  std::unique_ptr<int> taken = std::move(*made(3));
  EXPECT_EQ(*taken, 3);
  EXPECT_EQ(*made(4).value(), 4);
}

TEST(Expected, TakesWhateverMakesItsValue) {
  const Expected<std::string> text = "literal";
  EXPECT_EQ(*text, "literal");
  EXPECT_EQ(text->size(), 7U);
  EXPECT_EQ(Expected<std::string>().value_or("other"), "");
  EXPECT_EQ(Expected<std::string>(fail(kError)).value_or("other"), "other");
}

TEST(Expected, ThrowsItsErrorWhereItsValueIsAskedFor) {
  EXPECT_THROW((void)made(-1).value(), BadExpectedAccess);
  try {
    Expected<void>(fail(kError)).value();
    FAIL();
  } catch (const BadExpectedAccess& thrown) {
    EXPECT_STREQ(thrown.what(), "file: is gone\nand so is its folder");
    EXPECT_EQ(thrown.error().findings.size(), 2U);
  }
  EXPECT_NO_THROW(Expected<void>().value());
}

TEST(Expected, OfNothingIsSuccessOrAnError) {
  EXPECT_TRUE(Expected<void>());
  const Expected<void> bad = fail(Error::Kind::bad_input, "here", "it is wrong");
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().text(), "here: it is wrong");
}

TEST(Expected, AssertsThatWhatIsAskedForIsThere) {
  EXPECT_ASSERTS((void)*made(-1), "has_value()");
  EXPECT_ASSERTS((void)made(1).error(), "!has_value()");
  EXPECT_ASSERTS((void)Expected<void>().error(), "!has_value()");
}

}  // namespace
}  // namespace hooke
