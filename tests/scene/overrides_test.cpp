// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/overrides.h"

#include <gtest/gtest.h>

#include "hooke/scene/load_scene.h"
#include "minimal_scene.h"

namespace hooke {
namespace {

Expected<scene::LoadedScene> load_with(std::vector<std::string> overrides) {
  scene::LoadOptions options;
  options.overrides = std::move(overrides);
  return scene::parse_scene(kMinimalScene, "scene.json", ".", options);
}

std::string complaints(std::vector<std::string> overrides) {
  const auto loaded = load_with(std::move(overrides));
  return loaded ? "" : loaded.error().text();
}

TEST(Overrides, ReplaceAndAdd) {
  const auto loaded = load_with({"time.step=0.002", "materials.water.radius=0.25", "gravity=[0,0,-1]",
                                 "domain.walls=open", "materials.oil={\"radius\":1,\"mass\":1,\"stiffness\":5}",
                                 "particles[0].block.max[0]=4", "particles[1].material=oil",
                                 "particles[1].block={\"min\":[5,5,5],\"max\":[5,5,5],\"spacing\":1}", "name=a=b"});
  ASSERT_TRUE(loaded) << loaded.error().text();
  EXPECT_EQ(loaded->scene.time_step, 0.002);
  EXPECT_EQ(loaded->scene.steps, 500);
  EXPECT_EQ(loaded->scene.materials[0].radius, 0.25);
  EXPECT_EQ(loaded->scene.gravity, (Vec3d{0, 0, -1}));
  EXPECT_EQ(loaded->scene.domain.boundary[1], Boundary::open);
  EXPECT_EQ(loaded->scene.materials[1].name, "oil");
  EXPECT_EQ(loaded->particles.size(), 5U);
  EXPECT_EQ(loaded->scene.name, "a=b");
}

TEST(Overrides, TakeThePlaceOfWhatTheyExclude) {
  const auto loaded = load_with({"time.steps=7", "output.every_steps=3", "particles[0].block.count=9"});
  ASSERT_TRUE(loaded) << loaded.error().text();
  EXPECT_EQ(loaded->scene.steps, 7);
  EXPECT_EQ(loaded->scene.output.steps, 3);
  EXPECT_EQ(loaded->scene.output.seconds, 0);
  EXPECT_EQ(loaded->particles.size(), 9U);
  EXPECT_EQ(load_with({"time.steps=7", "time.end=0.5"})->scene.steps, 50);
}

TEST(Overrides, AreCheckedLikeTheSceneItself) {
  EXPECT_EQ(complaints({"time.step=-1"}), "time.step: is -1; must be a number > 0 (s)");
  EXPECT_EQ(complaints({"time.step=nan"}), "time.step: is \"nan\"; must be a number > 0 (s)");
  EXPECT_EQ(complaints({"time.step=1e999"}), "time.step: is 1e999, beyond the largest number (1.8e308)");
  EXPECT_EQ(complaints({"materials.water.radus=1"}).substr(0, 85),
            "materials.water.radus: is no key of a scene (its value: 1); did you mean \"radius\"? ke");
  EXPECT_EQ(
      complaints({"particles[0].material=wter"}),
      "particles[0].material: is \"wter\", which is no material; did you mean \"water\"? the scene has \"water\"");
  EXPECT_EQ(complaints({"particles[0].velocity={\"a\":1,\"a\":2}"}).substr(0, 74),
            "particles[0].velocity.a: is given twice in one object, the second time on ");
}

TEST(Overrides, WithoutAPlaceAreFindings) {
  EXPECT_EQ(complaints({"time.step"}), "--set time.step: must be PATH=VALUE, for instance time.step=0.002");
  EXPECT_EQ(complaints({"time..step=1"}).substr(0, 40), "--set time..step=1: the path must be key");
  EXPECT_EQ(complaints({"particles[7].material=a"}),
            "particles[7]: can't be set: particles is a list of 1 entry, counted from 0 (line 6)");
  EXPECT_EQ(complaints({"time.step.x=1"}), "time.step.x: can't be set: time.step is 0.01, which has no keys");
  EXPECT_EQ(complaints({"time[0]=1"}), "time[0]: can't be set: time is an object, no list");
  EXPECT_EQ(complaints({"name=\xff\xfe"}), "--set name=\xef\xbf\xbd\xef\xbf\xbd: is not valid UTF-8");
  EXPECT_EQ(complaints({"time.step", "time.end=-1"}).find("time.end") != std::string::npos, true);
}

}  // namespace
}  // namespace hooke
