// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "record.h"

#include <gmock/gmock.h>

#include "view_scene.h"

namespace hooke::test {
namespace {

using namespace view;
using testing::HasSubstr;

const std::vector<Action>& one_of_each() {
  static const std::vector<Action> actions = {
      AddBall{"red", {0.1, 1.0 / 3, -2e-9}, 0.25, {1, 2, 3}},
      HoldCollider{"ball", {0, 0.5, 0}},
      HoldParticles{{1, 7, 1234567890123}},
      Lead{{0.1, 0.2, 0.3}},
      LetGo{},
      CutSprings{{0, 5}},
      Scatter{42},
      Reset{},
      LoadCheckpoint{"/somewhere/checkpoint.h5"},
      ChangeScene{scene::Json::parse(R"([{"op": "replace", "path": "/gravity/1", "value": -1.6}])")},
  };
  return actions;
}

using Records = ViewTest;

TEST_F(Records, HoldEveryKindOfActionBitForBit) {
  ASSERT_EQ(one_of_each().size(), std::variant_size_v<Action>);
  for (const Action& action : one_of_each()) {
    const auto read = action_from_json(scene::Json::parse(to_json(action).dump()));
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->index(), action.index());
    EXPECT_EQ(to_json(*read), to_json(action));
  }
}

TEST_F(Records, AreReadAsTheyWereWrittenWithoutWhatWasTakenBack) {
  {
    auto writer = RecordWriter::create(path("a.record"), {path("scene.json"), {"time.step=0.002"}, true, "cpu"});
    ASSERT_TRUE(writer);
    writer->add_hash(0, 0xfedcba9876543210);
    writer->add(3, one_of_each()[0]);
    writer->add(5, one_of_each()[6]);
    writer->add_hash(10, 7);
    writer->add(12, one_of_each()[7]);
    writer->go_back(5, 1);
    writer->add_hash(6, 8);
  }
  const auto record = read_record(path("a.record"));
  ASSERT_TRUE(record) << record.error().text();
  EXPECT_EQ(record->head.scene, path("scene.json"));
  EXPECT_EQ(record->head.overrides, std::vector<std::string>{"time.step=0.002"});
  EXPECT_TRUE(record->head.allow_outside);
  ASSERT_EQ(record->entries.size(), 3u);
  EXPECT_EQ(std::get<std::uint64_t>(record->entries[0].what), 0xfedcba9876543210);
  EXPECT_EQ(record->entries[1].steps, 3);
  EXPECT_EQ(std::get<Action>(record->entries[1].what).index(), one_of_each()[0].index());
  EXPECT_EQ(std::get<std::uint64_t>(record->entries[2].what), 8u);
}

TEST_F(Records, ThatAreNoneAreErrorsWithTheLine) {
  const auto error_of = [&](const std::string& text) {
    write("bad.record", text);
    const auto record = read_record(path("bad.record"));
    return record ? std::string("read") : record.error().text();
  };
  const std::string head = R"({"hooke_record":1,"scene":"scene.json","set":[],"allow_outside":false,"device":"cpu"})";
  EXPECT_THAT(error_of(""), HasSubstr("is empty"));
  EXPECT_THAT(error_of("{}"), HasSubstr("bad.record:1: is no record"));
  EXPECT_THAT(error_of(R"({"hooke_record":2})"), HasSubstr("another version"));
  EXPECT_THAT(error_of(head + "\n{\"steps\":1,\"do\":\"dance\"}\n{\"steps\":1,\"do\":\"reset\"}\n"),
              HasSubstr("bad.record:2: do: \"dance\" is no action"));
  EXPECT_THAT(error_of(head + "\n{\"steps\":5,\"do\":\"reset\"}\n{\"steps\":4,\"do\":\"reset\"}\n\n"),
              HasSubstr("bad.record:3: its steps must not descend"));
  EXPECT_THAT(error_of(head + "\n{\"steps\":1,\"do\":\"lead\"}\n\n"), HasSubstr("bad.record:2"));
  // A last line that was cut off is what a killed window leaves.
  EXPECT_EQ(error_of(head + "\n{\"steps\":5,\"do\":\"reset\"}\n{\"steps\":6,\"do"), "read");
  EXPECT_FALSE(read_record(path("missing.record")));
}

}  // namespace
}  // namespace hooke::test
