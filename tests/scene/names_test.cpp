// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Names of materials may hold anything. What they hold must not be taken for something else, must not cost more than it
// is long, and must not reach a terminal.

#include <gtest/gtest.h>

#include <algorithm>

#include "file_reading.h"
#include "hooke/scene/load_scene.h"
#include "minimal_scene.h"

namespace hooke {
namespace {

class Names : public FileReading {
 protected:
  std::string refusal_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
    scene::LoadOptions options;
    options.overrides = overrides;
    const auto loaded = scene::parse_scene(text, "scene.json", folder_.path(), options);
    return loaded ? "" : loaded.error().text();
  }
};

TEST_F(Names, ThatLookLikeEscapesAreToldApart) {
  materials_[0].name = "salt%20water";
  const std::string species = "3\n\nsalt%20water 1 1 1\nsalt%2520water 2 2 2\nsalt%20water 3 3 3\n";
  EXPECT_EQ(read("p.xyz", species).material, (std::vector<std::uint16_t>{1, 0, 1}));
  materials_[1].name = "oil";
  EXPECT_EQ(read("p.xyz", species).material, (std::vector<std::uint16_t>{0, 0, 0})) << "as another program writes it";
  EXPECT_EQ(complaints(), "");
}

// Each "%25" stands for one "%", and what then looks like an escape is none.
TEST_F(Names, OfManyEscapesCostWhatTheyAreLong) {
  std::string name = "%";
  for (int i = 0; i < 300000; ++i) name += "25";
  const std::string head = "ply\nformat ascii 1.0\ncomment material 0 " + name + "\nelement vertex 20000\n";
  std::string text = head + "property float x\nproperty float y\nproperty float z\nproperty int material\nend_header\n";
  for (int i = 0; i < 10000; ++i) text += "1 1 1 0\n1 1 1 1\n";
  read("p.ply", text);
  const auto all = findings_.take();
  ASSERT_EQ(all.size(), 21U);
  EXPECT_LT(all[0].message.size(), 300U);
}

TEST_F(Names, AreShownWithoutControlCharacters) {
  std::string scene = kMinimalScene;
  scene.replace(scene.find("\"water\": {"), 10, R"("\u001b]0;t\u0007": { "x\u001b[31m": 1,)");
  const std::string text = refusal_of(scene);
  EXPECT_NE(text.find("materials[\"\\u001b]0;t\\u0007\"][\"x\\u001b[31m\"]: is no key"), std::string::npos) << text;
  EXPECT_NE(text.find("the scene has \"\\u001b]0;t\\u0007\""), std::string::npos) << text;
  EXPECT_TRUE(std::none_of(text.begin(), text.end(), [](char c) { return c == '\x1b' || c == '\a'; })) << text;
}

TEST_F(Names, OfAPathCanBeSet) {
  std::string scene = kMinimalScene;
  for (auto at = scene.find("water"); at != std::string::npos; at = scene.find("water")) scene.replace(at, 5, "a\\nb");
  EXPECT_EQ(refusal_of(scene), "");
  EXPECT_EQ(refusal_of(scene, {R"(materials["a\nb"].mass=-1)"}),
            "materials[\"a\\nb\"].mass: is -1; must be a number > 0 (kg)");
}

TEST_F(Names, AreRefusedBeforeAnythingIsMadeOfTheirPairs) {
  const auto scene_of = [](int count) {
    std::string materials;
    for (int i = 0; i < count; ++i) {
      materials += (i == 0 ? "" : ",") + ("\"m" + std::to_string(i)) + R"(":{"radius":0.1,"mass":1,"stiffness":1})";
    }
    return R"({"hooke":1,"time":{"step":0.01,"steps":1},"domain":{"min":[0,0,0],"max":[1,1,1]},"particles":[],
"materials":{)" +
           materials + "},\"colliders\":[{\"shape\":{\"sphere\":{\"center\":[0,0,0],\"radius\":1}}}]}";
  };
  EXPECT_EQ(refusal_of(scene_of(1024)), "");
  EXPECT_EQ(refusal_of(scene_of(1025)), "materials: has 1025 entries; at most 1024 are possible (line 2)");
  EXPECT_EQ(refusal_of(scene_of(70000)), "materials: has 70000 entries; at most 1024 are possible (line 2)");
}

// Linear: a fault more is a finding more, up to a number, and no look at all the others.
TEST_F(Names, OfVeryManyWrongKeysAreCountedOff) {
  std::string scene = kMinimalScene;
  std::string keys = "\"" + std::string(10000, 'k') + "\": { \"radius\": 1, \"mass\": 1,";
  for (int i = 0; i < 100000; ++i) keys += "\"w" + std::to_string(i) + "\":1,";
  scene.replace(scene.find("\"water\": {"), 10, keys);
  const std::string text = refusal_of(scene);
  EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')), scene::Findings::kMost);
  EXPECT_NE(text.find("scene.json: has more findings, which are left out here"), std::string::npos);
  EXPECT_LT(text.size(), 1000000U);
  std::string particles = "0";
  for (int i = 0; i < 200000; ++i) particles += ",0";
  EXPECT_NE(refusal_of(kMinimalScene, {"particles=[" + particles + "]"}).find("left out"), std::string::npos);
}

}  // namespace
}  // namespace hooke
