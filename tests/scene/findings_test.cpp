// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/findings.h"

#include <gtest/gtest.h>

namespace hooke {
namespace {

TEST(Findings, ComeInTheOrderOfTheText) {
  scene::Findings findings("s.json");
  findings.set_text("{\n\"a\": 1,\n\"b\": {\"c\": 2}}");
  findings.forget_lines("b.c");
  findings.add_elsewhere("p.csv:7", "is odd");
  findings.add("b.c", "is set elsewhere");
  findings.add("b.d", "is missing");
  findings.add("a", "is wrong");
  findings.add("", "is bad");
  EXPECT_TRUE(findings.touches("a.x"));
  EXPECT_TRUE(findings.touches("b"));
  const std::vector<Finding> expected{{"s.json", "is bad (line 1)"},
                                      {"a", "is wrong (line 2)"},
                                      {"b.d", "is missing (line 3)"},
                                      {"p.csv:7", "is odd"},
                                      {"b.c", "is set elsewhere"}};
  EXPECT_EQ(findings.take(), expected);
  EXPECT_TRUE(findings.empty());
}

TEST(Findings, StopWhereTheyWouldBuryEachOther) {
  scene::Findings findings("s.json");
  for (std::size_t i = 0; i < scene::Findings::kMost; ++i) findings.add("a" + std::to_string(i), "is wrong");
  EXPECT_FALSE(findings.overflows());
  EXPECT_FALSE(findings.touches("b"));
  findings.add("b", "is wrong");
  EXPECT_TRUE(findings.overflows());
  EXPECT_TRUE(findings.touches("c")) << "which may be among those that are left out";
  const auto all = findings.take();
  ASSERT_EQ(all.size(), scene::Findings::kMost + 1);
  EXPECT_EQ(all.back(), (Finding{"s.json", "has more findings, which are left out here"}));
}

TEST(Findings, ShowPlacesThatATerminalCanTake) {
  scene::Findings findings("s.json");
  findings.add_elsewhere("a\x1b[2J.csv:1", "is odd");
  findings.add(std::string(100000, 'k'), "is wrong");
  const auto all = findings.take();
  EXPECT_EQ(all[0].where, "a\\u001b[2J.csv:1");
  EXPECT_EQ(all[1].where.size(), 403U);
}

}  // namespace
}  // namespace hooke
