// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Names of materials that hold anything: they come back from every format that a scene reads, or are refused when they
// are written, and none of them steers a terminal.

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "program.h"

namespace hooke::test {
namespace {

using testing::HasSubstr;

class NamesTest : public ProgramTest, public testing::WithParamInterface<std::string> {
 protected:
  /// A scene of one particle of each material; or of those of a file.
  static std::string scene(const std::vector<std::string>& names, const std::string& file = "") {
    const nlohmann::json material{{"radius", 0.1}, {"mass", 1}, {"stiffness", 1000}};
    nlohmann::json scene{{"hooke", 1},
                         {"name", "named"},
                         {"time", {{"step", 0.001}, {"steps", 0}}},
                         {"domain", {{"min", {0, 0, 0}}, {"max", {9, 3, 3}}}},
                         {"particles", nlohmann::json::array()}};
    double x = 0.5;
    for (const std::string& name : names) {
      scene["materials"][name] = material;
      const nlohmann::json block{{"min", {x, 1, 1}}, {"max", {x, 1, 1}}, {"spacing", 1}};
      if (file.empty()) scene["particles"].push_back({{"material", name}, {"block", block}});
      x += 0.5;
    }
    if (!file.empty()) scene["particles"].push_back({{"file", file}});
    return scene.dump();
  }
};

TEST_P(NamesTest, ComeBack) {
  std::vector<std::string> names{"a b",   "a%20b", "a%2520b", " c ",          "\td",          "%",
                                 "\"e\"", "#1",    "1",       "\x1b[31m\x7f", "\xc3\xb6l, x", std::string(60, ' ')};
  if (GetParam() != ".csv") names.emplace_back("e\nf\r");
  write("s.json", scene(names));
  hooke_ok({"run", "s.json", "-q"});
  hooke_ok({"export", "s", "-o", "p" + GetParam()});
  write("again.json", scene(names, "p" + GetParam()));
  hooke_ok({"run", "again.json", "-q"});
  hooke_ok({"export", "s", "-o", "before.xyz"});
  hooke_ok({"export", "again", "-o", "after.xyz"});
  EXPECT_EQ(read("before.xyz"), read("after.xyz"));
}

TEST_P(NamesTest, AreWrittenWholeOrNotAtAll) {
  const std::string longest(300, 'n');
  std::string end(301, 'n');
  end.back() = 'm';
  write("s.json", scene({longest, end}));
  hooke_ok({"run", "s.json", "-q"});
  const Outcome exported = hooke({"export", "s", "-o", "p" + GetParam()});
  if (GetParam() == ".data") {
    EXPECT_EQ(exported.status, 2);
    EXPECT_THAT(exported.err, HasSubstr("can't hold the name of material \"nnn"));
    EXPECT_THAT(exported.err, HasSubstr("written as one word it takes 300 bytes; at most 200 fit"));
    EXPECT_FALSE(exists("p" + GetParam()));
    return;
  }
  EXPECT_EQ(exported.status, 0) << exported.err;
  write("again.json", scene({longest, end}, "p" + GetParam()));
  hooke_ok({"run", "again.json", "-q"});
  hooke_ok({"export", "s", "-o", "before.xyz"});
  hooke_ok({"export", "again", "-o", "after.xyz"});
  EXPECT_EQ(read("before.xyz"), read("after.xyz"));
}

INSTANTIATE_TEST_SUITE_P(Formats, NamesTest, testing::Values(".csv", ".ply", ".xyz", ".dump", ".data"),
                         [](const auto& test) { return test.param.substr(1); });

class Names : public NamesTest {};

TEST_F(Names, WithALineEndDoNotFitATable) {
  write("s.json", scene({"d\ne"}));
  hooke_ok({"run", "s.json", "-q"});
  const Outcome exported = hooke({"export", "s", "-o", "p.csv"});
  EXPECT_EQ(exported.status, 2);
  EXPECT_THAT(exported.err, HasSubstr("p.csv: can't hold the name of material \"d\\ne\": it holds the end of a line"));
  EXPECT_FALSE(exists("p.csv"));
}

TEST_F(Names, DoNotSteerATerminal) {
  const auto is_clean = [](const Outcome& outcome) {
    const auto steers = [](char c) { return static_cast<unsigned char>(c) < ' ' && c != '\n'; };
    const std::string all = outcome.out + outcome.err;
    return std::none_of(all.begin(), all.end(), steers);
  };
  const std::string name = "\x1b]0;t\x07";
  std::string text = scene({name});
  text.replace(text.find("named"), 5, "\\u001b[31m");
  write("s.json", text);
  EXPECT_TRUE(is_clean(hooke({"check", "s.json"})));
  EXPECT_TRUE(is_clean(hooke({"run", "s.json"})));
  const Outcome info = hooke({"info", "s"});
  EXPECT_EQ(info.status, 0);
  EXPECT_TRUE(is_clean(info));
  EXPECT_THAT(info.out, HasSubstr("material    \\u001b]0;t\\u0007: radius"));
  write("k.json", R"({"hooke":1,"\u001b[31mx":1,"time":{"step":1,"steps":1},"domain":{"min":[0,0,0],"max":[1,1,1]},
                      "materials":{"\u001b]0;t\u0007":{"radius":-1}},"particles":[{"material":"q\u001b","file":"\u009bf"}]})");
  const Outcome refused = hooke({"check", "k.json"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(is_clean(refused)) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr("materials[\"\\u001b]0;t\\u0007\"].radius: is -1"));
}

}  // namespace
}  // namespace hooke::test
