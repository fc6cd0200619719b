// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/json_path.h"

#include <gtest/gtest.h>

namespace hooke {
namespace {

TEST(JsonPath, TextAndPathAreTheSame) {
  for (const char* text : {"time", "time.step", "particles[0].block.min[2]", "materials[\"salt water\"].radius",
                           "materials[\"a.b\"]", "materials[\"say \\\"hi\\\"\"].mass", "x[1][2]", "$schema",
                           "materials[\"\\u001b[31m\"]", "materials[\"a\\nb\"]", "a[\"\"]", "a[\"\\u009b\"].b"}) {
    const auto path = scene::parse_path(text);
    ASSERT_TRUE(path) << text;
    EXPECT_EQ(scene::to_text(*path), text);
  }
}

TEST(JsonPath, RefusesWhatIsNone) {
  for (const char* text : {"", ".", "a.", ".a", "a..b", "a[", "a[]", "a[-1]", "a[x]", "[0]", "a[\"b]", "a b", "a[1"}) {
    EXPECT_FALSE(scene::parse_path(text)) << text;
  }
}

TEST(JsonPath, EscapesNameCharacters) {
  EXPECT_EQ(*scene::parse_path(R"(["\u001b\n\u00f6\x"])"), (scene::JsonPath{std::string("\x1b\n\xc3\xb6x")}));
  EXPECT_EQ(scene::join_path("", "a\tb"), R"(["a\tb"])");
}

TEST(PathSet, KnowsWhatLiesAboveAndBelow) {
  scene::PathSet set;
  EXPECT_FALSE(set.contains_at_or_above("time"));
  EXPECT_FALSE(set.contains_at_or_below(""));
  for (const char* path : {"time.step", "materials[\"a.b[0]\"].radius", "particles[1]", "materials.water-2"}) {
    set.insert(path);
  }
  EXPECT_TRUE(set.contains("time.step"));
  EXPECT_FALSE(set.contains("time"));
  for (const char* path : {"time.step", "time.step.x", "particles[1].block", "materials[\"a.b[0]\"].radius[0]"}) {
    EXPECT_TRUE(set.contains_at_or_above(path)) << path;
  }
  for (const char* path : {"time", "time.steps", "particles[10]", "materials[\"a.b[0]\"]", "materials.water"}) {
    EXPECT_FALSE(set.contains_at_or_above(path)) << path;
  }
  for (const char* path : {"", "time", "materials", "materials[\"a.b[0]\"]", "particles"}) {
    EXPECT_TRUE(set.contains_at_or_below(path)) << path;
  }
  for (const char* path : {"tim", "particle", "materials.water", "particles[1].x"}) {
    EXPECT_FALSE(set.contains_at_or_below(path)) << path;
  }
  set.insert("");
  EXPECT_TRUE(set.contains_at_or_above("anything"));
}

TEST(JsonPath, KnowsWhatLiesBelow) {
  EXPECT_TRUE(scene::is_at_or_below("time.step", "time"));
  EXPECT_TRUE(scene::is_at_or_below("particles[0]", "particles"));
  EXPECT_TRUE(scene::is_at_or_below("time", "time"));
  EXPECT_TRUE(scene::is_at_or_below("time", ""));
  EXPECT_FALSE(scene::is_at_or_below("timely", "time"));
  EXPECT_FALSE(scene::is_at_or_below("time", "time.step"));
}

}  // namespace
}  // namespace hooke
