// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/json_reader.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "hooke/scene/json_lines.h"

namespace hooke {
namespace {

constexpr const char* kLines = "// a scene\n{\n  \"b\": 1, /* two */\n  \"a\": [\n 1.5,\n\"x\"],\n\"c\": 12\n}";

TEST(JsonReader, KeepsOrderAndComments) {
  const scene::JsonReading r = scene::read_json(kLines, "t");
  ASSERT_TRUE(r.value);
  EXPECT_EQ(r.value->dump(), R"({"b":1,"a":[1.5,"x"],"c":12})");
  EXPECT_TRUE(r.faults.empty());
}

TEST(JsonReader, FindsTheLinesOfValues) {
  const std::vector<std::string> paths{"", "b", "a", "a[0]", "a[1]", "c", "a[2]", "a[0].d", "d", "d.e"};
  // A number's end is known only on the next line. What is missing has the line of what lacks it.
  const std::vector<int> lines{2, 3, 4, 5, 6, 7, 4, 5, 2, 0};
  EXPECT_EQ(scene::lines_of(kLines, paths), lines);
  std::string mac = kLines;
  std::replace(mac.begin(), mac.end(), '\n', '\r');
  EXPECT_EQ(scene::lines_of(mac, paths), lines);
  std::string windows;
  for (const char c : std::string_view(kLines)) windows += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(scene::lines_of(windows, paths), lines);
  EXPECT_EQ(scene::lines_of("{\"a\":1,\n\"a\":{\"b\":\n2}}", {"a", "a.b"}), (std::vector<int>{1, 1})) << "of the first";
  EXPECT_EQ(scene::lines_of("{\"a\":1,\n\"b\" 2}", {"a", "b"}), (std::vector<int>{1, 1})) << "no JSON";
}

TEST(JsonReader, PassesAByteOrderMark) {
  const scene::JsonReading r = scene::read_json("\xef\xbb\xbf{\"a\": 1}", "t");
  ASSERT_TRUE(r.value);
  EXPECT_EQ(r.value->dump(), R"({"a":1})");
  EXPECT_EQ(scene::read_json("\xef\xbb\xbf{\"a\" 1}", "t").stopped->where, "t:1:6");
  EXPECT_EQ(scene::read_json("\xef\xbb\xbf", "t").stopped->message, "is empty");
}

// Also where the text ends within a comment, a string or a word.
TEST(JsonReader, RefusesTheBeginningOfAText) {
  const std::string_view text = "{\"a\": [1.5, \"x\\u00e4\", true], /* of b */ \"b\": {\"c\": null}}";
  for (std::size_t size = 1; size < text.size(); ++size) {
    const scene::JsonReading r = scene::read_json(text.substr(0, size), "t");
    ASSERT_TRUE(r.stopped) << text.substr(0, size);
    EXPECT_EQ(r.stopped->where.rfind("t:1:", 0), 0U) << r.stopped->where;
    const int column = std::stoi(r.stopped->where.substr(4));
    EXPECT_GE(column, 1);
    EXPECT_LE(column, static_cast<int>(size) + 1) << text.substr(0, size);
  }
}

// A path of each value would take the product of both.
TEST(JsonReader, ReadsManyValuesBelowALongKey) {
  const std::string key(1000000, 'k');
  std::string text = "{\"" + key + "\":[0";
  for (int i = 0; i < 1000000; ++i) text += ",0";
  text += "],\n\"" + key + "\":{\"a\":0";
  for (int i = 0; i < 100000; ++i) text += ",\"a\":0";
  text += "}}";
  const scene::JsonReading r = scene::read_json(text, "t");
  ASSERT_TRUE(r.value);
  EXPECT_EQ(r.value->at(key).size(), 1000001U);
  ASSERT_EQ(r.faults.size(), 1U);
  EXPECT_EQ(scene::lines_of(text, {key + "[1000000]", key}), (std::vector<int>{1, 1}));
}

TEST(JsonReader, KeepsSomeOfManyFaults) {
  std::string text = "{\"" + std::string(100000, 'k') + "\":{\"a\":0";
  for (int i = 0; i < 100000; ++i) text += ",\"a\":0";
  EXPECT_EQ(scene::read_json(text + "}}", "t").faults.size(), scene::Findings::kMost + 1);
}

TEST(JsonReader, NamesThePlaceOfASyntaxError) {
  const scene::JsonReading r = scene::read_json("{\n  \"a\": 1,\n  \"b\" 2\n}", "scene.json");
  EXPECT_FALSE(r.value);
  EXPECT_TRUE(r.syntax_error);
  ASSERT_TRUE(r.stopped);
  EXPECT_EQ(r.stopped->where, "scene.json:3:7");
}

TEST(JsonReader, KeepsTheFirstOfDoubledKeys) {
  const scene::JsonReading r =
      scene::read_json("{\"a\": {\"x\": 1, \"x\": {\"y\": [1, 2]}}, \"b\": 2,\n\"b\": 3}", "t");
  ASSERT_TRUE(r.value);
  EXPECT_EQ(r.value->dump(), R"({"a":{"x":1},"b":2})");
  ASSERT_EQ(r.faults.size(), 2U);
  EXPECT_EQ(r.faults[0].first, "a.x");
  EXPECT_EQ(r.faults[1].first, "b");
  EXPECT_EQ(r.faults[1].second, "is given twice in one object, the second time on line 2");
}

TEST(JsonReader, ReportsEveryNumberThatOverflows) {
  const scene::JsonReading r = scene::read_json("{\"a\": 1e999, \"b\": [2, -1e400], \"a\": 0}", "t");
  ASSERT_TRUE(r.value);
  ASSERT_EQ(r.faults.size(), 3U);
  EXPECT_EQ(r.faults[0].first, "a");
  EXPECT_EQ(r.faults[0].second, "is 1e999, beyond the largest number (1.8e308)");
  EXPECT_EQ(r.faults[1].first, "b[1]");
  EXPECT_EQ(r.faults[2].first, "a");
  EXPECT_EQ(r.value->dump(), R"({"a":0,"b":[2,0]})");
}

TEST(JsonReader, LimitsDepth) {
  const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_TRUE(scene::read_json(nested(64), "t").value);
  const scene::JsonReading r = scene::read_json(nested(65), "t");
  EXPECT_FALSE(r.value);
  EXPECT_FALSE(r.syntax_error);
  ASSERT_TRUE(r.stopped);
  EXPECT_EQ(r.stopped->where, "t:1:65");
  EXPECT_FALSE(scene::read_json(nested(1000000), "t").value);
}

TEST(JsonReader, TakesWholeNumbersInAnyNotation) {
  const scene::JsonReading r = scene::read_json("[1e6, 4.0, -2.0, 0.5, 1e300, -0.0]", "t");
  ASSERT_TRUE(r.value);
  EXPECT_TRUE((*r.value)[0].is_number_integer());
  EXPECT_EQ(r.value->dump(), "[1000000,4,-2,0.5,1e+300,-0.0]");
}

TEST(JsonReader, SaysValuesInFewWords) {
  EXPECT_EQ(scene::brief(scene::Json(0.25)), "0.25");
  EXPECT_EQ(scene::brief(scene::Json("text")), "\"text\"");
  EXPECT_EQ(scene::brief(scene::Json::parse("[1,2,3]")), "[1,2,3]");
  EXPECT_EQ(scene::brief(scene::Json::parse("{\"a\":1}")), "an object");
  EXPECT_EQ(scene::brief(scene::Json(std::string(500, 'x'))).size(), 65U);
  EXPECT_EQ(printable("a\xff\n"), "a\xef\xbf\xbd\\n");
}

TEST(JsonReader, WritesForPeopleAndReadsBack) {
  const scene::Json value = scene::Json::parse(R"({"a":[0.1,-9.8,1e-300],"b":{"c":[{"d":true}],"e":{}},"f":[]})");
  const std::string text = scene::pretty(value);
  EXPECT_EQ(text,
            "{\n  \"a\": [0.1, -9.8, 1e-300],\n  \"b\": {\n    \"c\": [\n      {\n        \"d\": true\n      }\n"
            "    ],\n    \"e\": {}\n  },\n  \"f\": []\n}\n");
  EXPECT_EQ(scene::Json::parse(text), value);
}

}  // namespace
}  // namespace hooke
