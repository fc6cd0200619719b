// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/spelling.h"

#include <gtest/gtest.h>

namespace hooke {
namespace {

TEST(Nearest, FindsMisspellings) {
  const std::vector<std::string> names{"radius", "mass", "stiffness", "shear", "damping", "drag"};
  EXPECT_EQ(scene::nearest_name("radus", names), "radius");     // a letter left out
  EXPECT_EQ(scene::nearest_name("raduis", names), "radius");    // two swapped
  EXPECT_EQ(scene::nearest_name("mas", names), "mass");
  EXPECT_EQ(scene::nearest_name("dampening", names), "damping");
  EXPECT_EQ(scene::nearest_name("stifness", names), "stiffness");
  EXPECT_EQ(scene::nearest_name("temperature", names), "");
  EXPECT_EQ(scene::nearest_name("xy", {"ab"}), "");  // nothing in common
  EXPECT_EQ(scene::nearest_name("", names), "");
  EXPECT_EQ(scene::nearest_name(std::string(1000, 'r'), names), "");
}

TEST(Nearest, WordsIt) {
  EXPECT_EQ(scene::did_you_mean("watr", {"water"}), "; did you mean \"water\"?");
  EXPECT_EQ(scene::did_you_mean("gas", {"water"}), "");
  EXPECT_EQ(scene::quoted_list({"a", "b"}), "\"a\", \"b\"");
  EXPECT_EQ(scene::quoted_list(std::vector<std::string>(26, "a")).substr(113), ", \"a\" and 2 more");
}

}  // namespace
}  // namespace hooke
