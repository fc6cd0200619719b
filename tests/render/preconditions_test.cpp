// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
//
// A broken precondition is reported where it is broken: one test for each kind of precondition that headers state.

#include <gtest/gtest.h>

#include "hooke/core/scene.h"
#include "hooke/render/action.h"
#include "hooke/render/camera.h"
#include "hooke/render/cloth_meshes.h"
#include "hooke/render/color_map.h"
#include "hooke/render/frame.h"
#include "hooke/render/image.h"
#include "hooke/render/interpolate.h"
#include "hooke/render/visible_spheres.h"
#include "hooke/render/water_mixing.h"
#include "hooke/render/water_thickness.h"
#include "support/assertions.h"

namespace hooke {
namespace {

TEST(RenderPreconditions, CamerasLookSomewhere) {
  EXPECT_ASSERTS((void)render::axes({{1, 2, 3}, {1, 2, 3}, {0, 1, 0}, 35}), "camera.eye = (1, 2, 3)");
  EXPECT_ASSERTS((void)render::axes({{0, 0, 1}, {0, 0, 0}, {0, 2, 0}, 35}), "camera.up = (0, 2, 0)");
  EXPECT_ASSERTS((void)render::axes({{0, 1, 0}, {0, 0, 0}, {0, 1, 0}, 35}), "camera.up = (0, 1, 0)");
  EXPECT_ASSERTS((void)render::default_camera({}, {0, 1, 0}, 180, 1), "field_of_view = 180");
  EXPECT_ASSERTS((void)render::default_camera({}, {0, 1, 0}, 35, 0), "aspect = 0");
  EXPECT_ASSERTS((void)render::extent_along({}, {1, 1, 0}), "direction = (1, 1, 0)");
  EXPECT_ASSERTS((void)render::project(render::Camera{}, 0, 720), "width = 0, height = 720");
}

TEST(RenderPreconditions, ParticlesAreTheScenes) {
  const Scene scene;
  ParticleSet particles;
  particles.id = {1};
  EXPECT_ASSERTS((void)render::make_frame(scene, particles, 0, {}, 1), "are_particles_of");
  EXPECT_ASSERTS((void)render::action_box(scene, particles), "are_particles_of");
}

TEST(RenderPreconditions, ScalesRise) {
  const Scene scene;
  EXPECT_ASSERTS((void)render::make_look(scene, {}, render::ColorBy::speed, {{2, 2}}),
                 "(*range)[0] = 2, (*range)[1] = 2");
  EXPECT_ASSERTS((void)render::make_frame(scene, {}, 0, {{}, {render::ColorBy::speed, 1, 0}, 1}, 1),
                 "look.scale.high = 0");
}

TEST(RenderPreconditions, TimesAreBetweenTheMoments) {
  const Scene scene;
  const ParticleSet none;
  EXPECT_ASSERTS((void)render::interpolate(scene, {1, none}, {2, none}, 3),
                 "before.time = 1, time = 3, after.time = 2");
  EXPECT_ASSERTS((void)render::drawn_back(scene, none, -1), "seconds = -1");
}

TEST(RenderPreconditions, PixelsAreThePictures) {
  render::Image image(4, 2);
  EXPECT_ASSERTS((void)image.at(4, 0), "x = 4, y = 0, width = 4, height = 2");
  EXPECT_ASSERTS((void)image.at(0, -1), "y = -1");
  image.pixels.pop_back();
  EXPECT_ASSERTS((void)render::encode_png(image), "image.pixels.size() = 31");
}

TEST(RenderPreconditions, SizesArePositive) {
  EXPECT_ASSERTS((void)render::water_mixing({}, {}, 0, 1), "radius = 0");
  EXPECT_ASSERTS((void)render::water_mixing({}, {}, 1, 0), "fastest = 0");
  EXPECT_ASSERTS((void)render::seen_action_box({}, {}), "moments");
  EXPECT_ASSERTS((void)render::visible_spheres({}, {}), "view.width = 0");
  EXPECT_ASSERTS((void)render::water_thickness({}, {}), "view.width = 0");
  const std::uint32_t one = 1;
  EXPECT_ASSERTS((void)render::bounds_on_picture({}, std::span(&one, 1), {}), "i = 1, spheres.size() = 0");
}

TEST(RenderPreconditions, ClothsAreOfAStructure) {
  std::vector<char> covered;
  EXPECT_ASSERTS((void)render::cloth_meshes({}, {}, {0, 0, 0}, nullptr, covered), "scene.structure != nullptr");
  EXPECT_ASSERTS((void)render::parse_color(nullptr), "text != nullptr");
}

}  // namespace
}  // namespace hooke
