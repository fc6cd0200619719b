// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// What a scene says of its pictures, and the warnings about defaults.
#include <gtest/gtest.h>

#include "hooke/scene/load_scene.h"
#include "minimal_scene.h"

namespace hooke {
namespace {

Expected<scene::LoadedScene> load(std::vector<std::string> overrides) {
  scene::LoadOptions options;
  options.overrides = std::move(overrides);
  return scene::parse_scene(kMinimalScene, "scene.json", ".", options);
}

std::string error_of(std::vector<std::string> overrides) {
  const auto loaded = load(std::move(overrides));
  return loaded ? "no error" : loaded.error().text();
}

TEST(ScenePictures, HaveDefaults) {
  const auto loaded = load({});
  ASSERT_TRUE(loaded) << loaded.error().text();
  const ScenePicture& picture = loaded->scene.picture;
  EXPECT_TRUE(picture.box && picture.ground && picture.ground_lines);
  EXPECT_EQ(picture.background, "studio");
  EXPECT_FALSE(picture.sun);
  EXPECT_EQ(picture.springs, SpringLook::none);
  EXPECT_EQ(loaded->scene.camera.roll, 0);
  EXPECT_TRUE(loaded->scene.camera.keyframes.empty());
  const Material& water = loaded->scene.materials[0];
  EXPECT_EQ(water.foam, 1);
  EXPECT_EQ(water.opacity, 1);
  EXPECT_EQ(water.roughness, 0.5);
}

TEST(ScenePictures, AreAsTheSceneSays) {
  const auto loaded = load({R"(picture={"box": false, "ground": false, "ground_lines": false, "ground_color": "#010203",
                   "background": "#ffffff", "sun": [1, 2, 3], "sunlight": 0.5, "skylight": 2, "springs": "strain"})",
                            R"(camera={"eye": [9, 9, 9], "roll": 5, "follow": {"material": "water"},
                  "keyframes": [{"time": 1, "eye": [1, 2, 3]}, {"time": 2, "target": [4, 5, 6], "roll": 7}]})",
                            "materials.water.look=skin", "materials.water.foam=0.25", "materials.water.opacity=0.5",
                            "materials.water.roughness=0"});
  ASSERT_TRUE(loaded) << loaded.error().text();
  const ScenePicture& picture = loaded->scene.picture;
  EXPECT_FALSE(picture.box || picture.ground || picture.ground_lines);
  EXPECT_EQ(picture.ground_color, "#010203");
  EXPECT_EQ(picture.background, "#ffffff");
  EXPECT_EQ(picture.sun, (Vec3d{1, 2, 3}));
  EXPECT_EQ(picture.sunlight, 0.5);
  EXPECT_EQ(picture.skylight, 2);
  EXPECT_EQ(picture.springs, SpringLook::strain);
  const SceneCamera& camera = loaded->scene.camera;
  ASSERT_EQ(camera.keyframes.size(), 2u);
  EXPECT_EQ(camera.keyframes[0].eye, (Vec3d{1, 2, 3}));
  EXPECT_FALSE(camera.keyframes[0].target || camera.keyframes[0].roll);
  EXPECT_EQ(camera.keyframes[1].roll, 7);
  ASSERT_TRUE(camera.follow);
  EXPECT_EQ(camera.follow->material, 0u);
  const Material& water = loaded->scene.materials[0];
  EXPECT_EQ(water.look, MaterialLook::skin);
  EXPECT_EQ(water.foam, 0.25);
  EXPECT_EQ(water.opacity, 0.5);
  EXPECT_EQ(water.roughness, 0);
}

TEST(ScenePictures, FollowACollider) {
  const std::string collider =
      R"(colliders=[{"name": "ball", "shape": {"sphere": {"center": [1, 1, 1], "radius": 0.1}}}])";
  const auto loaded = load({collider, R"(camera.follow={"collider": "ball"})"});
  ASSERT_TRUE(loaded) << loaded.error().text();
  EXPECT_EQ(loaded->scene.camera.follow->collider, 0u);
  EXPECT_EQ(error_of({collider, R"(camera.follow={"collider": "bal"})"}),
            "camera.follow.collider: is \"bal\", which is no collider; did you mean \"ball\"? the scene has \"ball\"");
}

TEST(ScenePictures, AreRefusedWhereTheyMakeNoSense) {
  const auto expect_says = [](const std::string& override, const std::string& what) {
    const std::string text = error_of({override});
    EXPECT_NE(text.find(what), std::string::npos) << override << ": " << text;
  };
  expect_says("picture.boxes=true", "box");
  expect_says("picture.background=blue", "picture.background");
  expect_says("picture.sun=[0,0,0]", "picture.sun");
  expect_says("picture.sunlight=-1", "picture.sunlight");
  expect_says("picture.springs=red", "strain");
  expect_says("materials.water.opacity=1.5", "materials.water.opacity");
  expect_says("materials.water.foam=-1", "materials.water.foam");
  expect_says(R"(camera.follow={})", "camera.follow");
  expect_says(R"(camera.follow={"material": "oil"})", "no material");
  expect_says(R"(camera.keyframes=[{"time": 1}, {"time": 1}])", "must be later");
  expect_says(R"(camera.keyframes=[{"eye": [1, 2, 3]}])", "time");
  expect_says(R"(camera.keyframes=[{"time": 0, "eye": [1, 2, 3], "target": [1, 2, 3]}])", "eye at the target");
}

TEST(DefaultWarnings, NameTheKeyThatSurprises) {
  EXPECT_TRUE(load({})->warnings.empty());
  const auto grains = load({"materials.water.tension=false"});
  ASSERT_EQ(grains->warnings.size(), 1u);
  EXPECT_EQ(grains->warnings[0].where, "materials.water.friction");
  EXPECT_TRUE(load({"materials.water.tension=false", "materials.water.friction=0.5"})->warnings.empty());

  const std::string cloth =
      R"(cloths=[{"material": "water", "corner": [1, 2, 1], "edges": [[1, 0, 0], [0, 0, 1]], "cells": [2, 2], "stretch": 9}])";
  const std::string wind = R"(fields=[{"wind": {"velocity": [1, 0, 0], "drag": 0.1}}])";
  const auto flag = load({cloth, wind});
  ASSERT_TRUE(flag) << flag.error().text();
  ASSERT_EQ(flag->warnings.size(), 1u);
  EXPECT_EQ(flag->warnings[0].where, "fields[0].wind.area_drag");
  EXPECT_TRUE(load({cloth, wind, "fields[0].wind.area_drag=4"})->warnings.empty());
  EXPECT_TRUE(load({wind})->warnings.empty()) << "no cloths";
}

}  // namespace
}  // namespace hooke
