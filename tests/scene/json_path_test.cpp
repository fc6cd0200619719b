// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/json_path.h"

#include <gtest/gtest.h>

namespace hooke {
namespace {

TEST(JsonPath, TextAndPathAreTheSame) {
  for (const char* text : {"time", "time.step", "particles[0].block.min[2]", "materials[\"salt water\"].radius",
                           "materials[\"a.b\"]", "materials[\"say \\\"hi\\\"\"].mass", "x[1][2]", "$schema"}) {
    const auto path = parse_path(text);
    ASSERT_TRUE(path) << text;
    EXPECT_EQ(to_text(*path), text);
  }
}

TEST(JsonPath, RefusesWhatIsNone) {
  for (const char* text : {"", ".", "a.", ".a", "a..b", "a[", "a[]", "a[-1]", "a[x]", "[0]", "a[\"b]", "a b", "a[1"}) {
    EXPECT_FALSE(parse_path(text)) << text;
  }
}

TEST(JsonPath, KnowsWhatLiesBelow) {
  EXPECT_TRUE(is_at_or_below("time.step", "time"));
  EXPECT_TRUE(is_at_or_below("particles[0]", "particles"));
  EXPECT_TRUE(is_at_or_below("time", "time"));
  EXPECT_TRUE(is_at_or_below("time", ""));
  EXPECT_FALSE(is_at_or_below("timely", "time"));
  EXPECT_FALSE(is_at_or_below("time", "time.step"));
}

}  // namespace
}  // namespace hooke
