// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Mesa's software driver draws the pictures, so that they are the same on any machine with the same version of Mesa.
//
// Where HOOKE_UPDATE_IMAGES is set, the stored pictures are written instead of compared (target update_test_images).

#include "hooke/render/gl/gl_renderer.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "hooke/render/frame.h"
#include "hooke/render/legend.h"
#include "hooke/render/visible_spheres.h"
#include "picture_scenes.h"
#include "source_dir.h"
#include "support/environment.h"
#include "support/similarity.h"

namespace hooke::test {
namespace {

constexpr int kWidth = 320, kHeight = 180;
constexpr double kAspect = static_cast<double>(kWidth) / kHeight;
constexpr double kMostDifferent = 0.97;

class GlRenderer : public testing::Test {
 protected:
  static void SetUpTestSuite() { use_software_gl(); }

  static render::Renderer& renderer() {
    static const std::unique_ptr<render::Renderer> shared = make({kWidth, kHeight, 2});
    return *shared;
  }

  // Throws, with the reason, where there is no OpenGL: the machine is not set up (tools/setup.sh).
  static std::unique_ptr<render::Renderer> make(const render::RenderSettings& settings) {
    auto made = render::make_gl_renderer(settings);
    if (!made) throw std::runtime_error(made.error().text());
    return std::move(*made);
  }

  static render::Image draw(const render::Frame& frame) {
    auto image = renderer().render(frame);
    if (!image) throw std::runtime_error(image.error().text());
    return std::move(*image);
  }
};

render::Frame frame_of(const PictureScene& p) {
  return render::make_frame(p.scene, p.particles, p.time, render::make_look(p.scene, p.particles, p.by), kAspect);
}

// Red balls, radius 0.5, in a tank of 8 x 4 x 6 m.
render::Frame red_balls(const std::vector<Vec3d>& at, const char* color = "#e01010") {
  PictureScene p{"", ball_tank({8, 4, 6}, 0.5, color), {}};
  ParticleSet high;  // gives the same camera for any balls
  add(high, {4, 3.5, 3});
  for (const Vec3d& position : at) add(p.particles, position);
  return render::make_frame(p.scene, p.particles, 0, render::make_look(p.scene, high, render::ColorBy::material),
                            kAspect);
}

// The pixel that the centre of a sphere falls on.
std::array<int, 2> pixel_of(const render::Frame& frame, std::size_t index) {
  const render::Projection view = render::project(frame.camera, kWidth, kHeight);
  const render::Sphere& s = frame.spheres.at(index);
  const Vec3f to{s.x - view.eye.x, s.y - view.eye.y, s.z - view.eye.z};
  const float scale = view.scale / -dot(to, view.back);
  return {static_cast<int>(0.5f * kWidth + scale * dot(to, view.right)),
          static_cast<int>(0.5f * kHeight - scale * dot(to, view.up))};
}

using Pixel = std::array<int, 3>;
Pixel at(const render::Image& image, int x, int y) {
  const std::uint8_t* p = image.at(x, y);
  return {p[0], p[1], p[2]};
}

bool is_red(const Pixel& p) { return p[0] > 2 * p[1] && p[0] > 2 * p[2] && p[0] > 25; }
bool is_green(const Pixel& p) { return p[1] > 2 * p[0] && p[1] > 2 * p[2] && p[1] > 25; }

template <class Is>
int count(const render::Image& image, const Is& is) {
  int n = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) n += is(at(image, x, y)) ? 1 : 0;
  }
  return n;
}

// The same tank with a collider of a green material around or beside the balls.
render::Frame with_collider(const std::vector<Vec3d>& balls, const Shape& shape, bool hollow) {
  PictureScene p{"", ball_tank({8, 4, 6}, 0.5, "#e01010"), {}};
  ParticleSet high;
  add(high, {4, 3.5, 3});
  for (const Vec3d& position : balls) add(p.particles, position);
  Material green;
  green.name = "green";
  green.color = "#10c010";
  p.scene.materials.push_back(green);
  p.scene.colliders.resize(1);
  p.scene.colliders[0].shape = shape;
  p.scene.colliders[0].hollow = hollow;
  p.scene.colliders[0].material = p.scene.materials.size() - 1;
  return render::make_frame(p.scene, p.particles, 0, render::make_look(p.scene, high, render::ColorBy::material),
                            kAspect);
}

TEST_F(GlRenderer, ASphereOfACollidersIsDrawnLikeABall) {
  const render::Image ball = draw(red_balls({{4, 1, 3}})),
                      sphere = draw(with_collider({}, SphereShape{{4, 1, 3}, 0.5}, false));
  const double area = count(ball, is_red);
  EXPECT_GT(area, 200);
  EXPECT_NEAR(count(sphere, is_green) / area, 1, 0.05) << "a polygon of 96 sides, and darker at its edge";
  EXPECT_EQ(count(sphere, is_red), 0);
}

TEST_F(GlRenderer, ASolidColliderHidesWhatIsInItAndAHollowOneShowsIt) {
  const Shape box = BoxShape{{3, 0.1, 2}, {5, 2.1, 4}};
  const render::Image solid = draw(with_collider({{4, 1, 3}}, box, false)),
                      hollow = draw(with_collider({{4, 1, 3}}, box, true));
  EXPECT_EQ(count(solid, is_red), 0);
  EXPECT_GT(count(solid, is_green), 500);
  EXPECT_GT(count(hollow, is_red), 0.95 * count(draw(red_balls({{4, 1, 3}})), is_red));
  EXPECT_GT(count(hollow, is_green), 500) << "its far side";
}

TEST_F(GlRenderer, DrawsWithTheSoftwareDriver) { EXPECT_THAT(renderer().device(), testing::HasSubstr("llvmpipe")); }

TEST_F(GlRenderer, ABallIsWhereItIsAndNowhereElse) {
  const render::Frame frame = red_balls({{2, 0.5, 3}, {6, 3, 2}});
  const render::Image image = draw(frame), empty = draw(red_balls({}));
  EXPECT_EQ(count(empty, is_red), 0);
  double area = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto [x, y] = pixel_of(frame, i);
    EXPECT_TRUE(is_red(at(image, x, y))) << testing::PrintToString(at(image, x, y));
    const render::Projection view = render::project(frame.camera, kWidth, kHeight);
    const render::Sphere& s = frame.spheres[i];
    const float depth = -dot(Vec3f{s.x, s.y, s.z} - view.eye, view.back);
    const double radius = static_cast<double>(view.scale * s.radius / depth);
    area += std::numbers::pi * radius * radius;
    // Just inside and just outside the ball's rim, at the top, where there is light.
    EXPECT_TRUE(is_red(at(image, x, y - static_cast<int>(0.85 * radius))));
    EXPECT_FALSE(is_red(at(image, x, y - static_cast<int>(1.2 * radius))));
  }
  EXPECT_NEAR(count(image, is_red), area, 0.12 * area);
  // Far from the balls and their shadows, the picture is the same as without balls.
  EXPECT_EQ(at(image, 1, 1), at(empty, 1, 1));
  EXPECT_EQ(at(image, kWidth - 2, kHeight / 8), at(empty, kWidth - 2, kHeight / 8));
}

TEST_F(GlRenderer, WithoutParticlesNothingIsDrawn) {
  const render::Image image = draw(red_balls({}));
  EXPECT_EQ(renderer().figures().spheres_drawn, 0u);
  EXPECT_EQ(count(image, [](const Pixel& p) { return is_red(p) || is_green(p); }), 0);
  EXPECT_GT(count(image, [](const Pixel& p) { return p[0] + p[1] + p[2] > 30; }), kWidth * kHeight / 2);
}

TEST_F(GlRenderer, WhatIsHiddenDoesNotShow) {
  render::Frame frame = red_balls({{4, 2, 3}, {4, 2, 3}});
  // The second ball, green and smaller, is right behind the first.
  const Vec3d back = render::axes(frame.camera).back;
  render::Sphere& hidden = frame.spheres[1];
  const auto put = [&](double distance) {
    const Vec3f place = vec_cast<float>(distance * back);
    hidden = {frame.spheres[0].x + place.x,
              frame.spheres[0].y + place.y,
              frame.spheres[0].z + place.z,
              0.2f,
              {16, 224, 16},
              0};
  };
  put(-0.8);
  EXPECT_EQ(count(draw(frame), is_green), 0);
  put(-0.2);  // inside
  EXPECT_EQ(count(draw(frame), is_green), 0);
  put(0.8);  // in front of it
  EXPECT_GT(count(draw(frame), is_green), 20);
  put(0.4);  // sticks out of it
  EXPECT_GT(count(draw(frame), is_green), 5);
}

TEST_F(GlRenderer, ABallCastsAShadowOnTheGround) {
  const render::Image with = draw(red_balls({{4, 2.5, 3}})), without = draw(red_balls({}));
  int darker = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (is_red(at(with, x, y))) continue;
      darker += with.at(x, y)[1] + 8 < without.at(x, y)[1] ? 1 : 0;
    }
  }
  EXPECT_GT(darker, 50);
}

TEST_F(GlRenderer, FromInsideOfABallItIsNotSeen) {
  render::Frame frame = red_balls({{4, 2, 3}});
  frame.camera.eye = {frame.spheres[0].x + 0.1, frame.spheres[0].y, frame.spheres[0].z};
  EXPECT_EQ(count(draw(frame), is_red), 0);
}

TEST_F(GlRenderer, ChurnedWaterIsWhite) {
  PictureScene p{"", ball_tank({4, 2, 3}, 0.1, "#2f7fd6"), {}};
  p.scene.materials[0].look = MaterialLook::water;
  for (int k = 0; k < 40 * 20 * 30; ++k) {
    add(p.particles, {0.1 * (k % 40) + 0.05, 0.1 * (k / 1200) + 0.05, 0.1 * (k / 40 % 30) + 0.05});
  }
  const render::Look look = render::make_look(p.scene, p.particles, render::ColorBy::material);
  const auto middle = [&] {
    const render::Image image = draw(render::make_frame(p.scene, p.particles, 0, look, kAspect));
    return at(image, kWidth / 2, kHeight / 2);
  };
  const Pixel still = middle();
  EXPECT_GT(still[2], still[0] + 20) << testing::PrintToString(still);
  for (Vec3d& velocity : p.particles.velocity) velocity = {look.foam_speed, 0, 0};
  EXPECT_EQ(middle(), still) << "however fast it moves together";
  for (std::size_t i = 0; i < p.particles.size(); i += 2) p.particles.velocity[i] = {-look.foam_speed, 0, 0};
  const Pixel white = middle();
  EXPECT_GT(white[0], still[0] + 40) << testing::PrintToString(white);
  EXPECT_LT(white[2] - white[0], 60) << testing::PrintToString(white);
}

// A drop is clear: what is behind it shows, so a red ball is seen through it.
TEST_F(GlRenderer, WaterIsSeenThrough) {
  render::Frame frame = red_balls({{4, 2, 3}, {4, 2, 3}});
  render::Sphere& drop = frame.spheres[1];
  const Vec3f towards = vec_cast<float>(0.9 * render::axes(frame.camera).back);
  drop = {drop.x + towards.x, drop.y + towards.y, drop.z + towards.z, 0.25f, {0xd0, 0xe4, 0xf4}, 1, false, false, 255};
  const render::Image both = draw(frame);
  EXPECT_EQ(renderer().figures().spheres_drawn, 2u);
  const auto [x, y] = pixel_of(frame, 1);
  const Pixel through = at(both, x, y);
  EXPECT_GT(through[0], std::max(through[1], through[2]) + 60) << testing::PrintToString(through);
  frame.spheres.resize(1);
  EXPECT_NE(at(draw(frame), x, y), at(both, x, y)) << "but it is there";
}

TEST_F(GlRenderer, GlassIsSeenThrough) {
  const auto with_opacity = [](double opacity) {
    PictureScene p{"", ball_tank({8, 4, 6}, 0.5, "#e01010"), {}};
    ParticleSet high;
    add(high, {4, 3.5, 3});
    add(p.particles, {4, 1, 3});
    Material glass;
    glass.name = "glass";
    glass.color = "#10c010";
    glass.opacity = opacity;
    p.scene.materials.push_back(glass);
    p.scene.colliders.resize(1);
    p.scene.colliders[0].shape = BoxShape{{3, 0.1, 2}, {5, 2.1, 4}};
    p.scene.colliders[0].material = p.scene.materials.size() - 1;
    return draw(render::make_frame(p.scene, p.particles, 0, render::make_look(p.scene, high, render::ColorBy::material),
                                   kAspect));
  };
  const int alone = count(with_opacity(0), is_red);
  EXPECT_EQ(alone, count(draw(red_balls({{4, 1, 3}})), is_red)) << "not drawn";
  EXPECT_EQ(count(with_opacity(1), is_red), 0);
  EXPECT_GT(count(with_opacity(0.1), is_red), 0.5 * alone);
  EXPECT_NE(with_opacity(0.1).pixels, with_opacity(0).pixels);
}

TEST_F(GlRenderer, SkinIsSmooth) {
  PictureScene p{"", ball_tank({8, 4, 6}, 0.15, "#e01010"), {}};
  for (int k = 0; k < 20 * 12; ++k) add(p.particles, {2 + 0.2 * (k % 20), 0.5 + 0.2 * (k / 20), 3});
  // How much the picture's brightness varies over the wall of balls.
  const auto roughness = [&] {
    const render::Image image = draw(frame_of(p));
    double sum = 0;
    for (int x = kWidth / 2 - 30; x < kWidth / 2 + 30; ++x) {
      sum += std::abs(at(image, x + 1, kHeight / 2)[0] - at(image, x, kHeight / 2)[0]);
    }
    return sum;
  };
  const double balls = roughness();
  p.scene.materials[0].look = MaterialLook::skin;
  EXPECT_LT(roughness(), 0.25 * balls);
}

TEST_F(GlRenderer, ABackgroundIsItsColour) {
  PictureScene p{"", ball_tank({8, 4, 6}, 0.5, "#e01010"), {}};
  add(p.particles, {4, 2, 3});
  p.scene.picture.background = "#c86432";
  p.scene.picture.ground = p.scene.picture.box = false;
  const Pixel corner = at(draw(frame_of(p)), 2, 2);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(corner[k], (Pixel{0xc8, 0x64, 0x32}[k]), 2) << k;
}

TEST_F(GlRenderer, AlphaTellsWhereSomethingIs) {
  render::Frame frame = red_balls({{4, 2, 3}});
  EXPECT_EQ(draw(frame).at(2, 2)[3], 255);
  frame.transparent = true;
  frame.ground.reset();
  frame.tank.walls = {};
  const render::Image image = draw(frame);
  const auto [x, y] = pixel_of(frame, 0);
  EXPECT_EQ(image.at(x, y)[3], 255);
  EXPECT_TRUE(is_red(at(image, x, y)));
  EXPECT_EQ(image.at(2, 2)[3], 0);
}

// How far an sRGB picture may be from the linear one, steps of 8 bits. Each stage rounds the root of the light to half
// a step, which sRGB stretches by 1.446 at most: 12.92 (2 r) where the root r has sRGB's kink, r^2 = 0.0031308. The
// linear one keeps roots as half floats, of 11 bits. Then follow noise of half a step and the last rounding.
double most_rounding(int stages) { return stages * (0.5 + 255.0 / 4096) * 1.446 + 0.5 + 0.5; }

// Linear light as an sRGB picture stores it.
double as_stored(double light) {
  const double l = std::clamp(light, 0.0, 1.0);
  return 255 * (l < 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055);
}

TEST_F(GlRenderer, LinearLightIsTheSamePictureNotCutOffAtWhite) {
  // One sample a pixel: the mean of several differs where some of them are brighter than white.
  render::RenderSettings settings{kWidth, kHeight, 1};
  const auto stored = make(settings);
  settings.linear = true;
  const auto linear = make(settings);
  for (const PictureScene& p : picture_scenes()) {
    render::Frame frame = frame_of(p);
    frame.tank.walls = {};  // their edges are blended with what lies behind as the target keeps it, so differently
    const auto drawn = stored->render(frame);
    const auto light = linear->render_linear(frame);
    ASSERT_TRUE(drawn) << drawn.error().text();
    ASSERT_TRUE(light) << light.error().text();
    const render::Image& image = *drawn;
    double most = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const double expected = i % 4 == 3 ? 255.0 * light->pixels[i] : as_stored(light->pixels[i]);
      most = std::max(most, std::abs(expected - image.pixels[i]));
    }
    // Water is shaded over the picture behind it, whose roots are rounded, too.
    EXPECT_LE(most, most_rounding(p.scene.materials[0].look == MaterialLook::water ? 2 : 1)) << p.name;
  }
  render::Frame bright = red_balls({{4, 2, 3}}, "#ffffff");
  bright.spheres[0].roughness = 0;
  bright.sunlight = 3;
  const auto light = linear->render_linear(bright);
  ASSERT_TRUE(light);
  EXPECT_GT(*std::max_element(light->pixels.begin(), light->pixels.end()), 1.5f);
}

TEST_F(GlRenderer, LinearLightIsMultipliedByAlpha) {
  render::RenderSettings settings{kWidth, kHeight, 4};
  settings.linear = true;
  render::Frame frame = red_balls({{4, 2, 3}});
  frame.transparent = true;
  frame.ground.reset();
  frame.tank.walls = {};
  const auto light = make(settings)->render_linear(frame);
  ASSERT_TRUE(light);
  EXPECT_EQ(light->at(2, 2)[0], 0);
  EXPECT_EQ(light->at(2, 2)[3], 0);
  int partly = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const float* p = light->at(x, y);
      if (p[3] == 0 || p[3] == 1) continue;
      ++partly;
      EXPECT_LT(p[0], p[3]) << "a red of no more than white";
    }
  }
  EXPECT_GT(partly, 20) << "the edge of the ball";
}

// At night, balls that do not glow are dark, and balls that glow are as bright as their colour.
TEST_F(GlRenderer, SparksShineByThemselves) {
  render::Frame frame = red_balls({{4, 2, 3}});
  frame.daylight = 0.12f;
  EXPECT_EQ(count(draw(frame), [](const Pixel& p) { return p[0] > 150 && p[2] < 120; }), 0);
  frame.spheres[0].glows = true;
  EXPECT_GT(count(draw(frame), [](const Pixel& p) { return p[0] > 150 && p[2] < 120; }), 50);
}

TEST_F(GlRenderer, APictureDoesNotDependOnThoseBefore) {
  const auto scenes = picture_scenes();
  const render::Image first = draw(frame_of(scenes[0]));
  for (const PictureScene& other : scenes) draw(frame_of(other));
  draw(red_balls({}));
  EXPECT_EQ(draw(frame_of(scenes[0])).pixels, first.pixels);
  EXPECT_EQ((*make({kWidth, kHeight, 2})->render(frame_of(scenes[0]))).pixels, first.pixels);
}

TEST_F(GlRenderer, LeavesOutWhatCanNotBeSeenAndNothingElse) {
  for (const PictureScene& p : picture_scenes()) {
    const render::Image image = draw(frame_of(p));
    const render::RenderFigures figures = renderer().figures();
    EXPECT_LE(figures.spheres_drawn, p.particles.size()) << p.name;
    EXPECT_GT(figures.spheres_drawn, p.particles.size() / 20) << p.name;
    EXPECT_GT(figures.total_seconds, figures.cull_seconds);
  }
}

TEST_F(GlRenderer, OddSizesAndAllSamples) {
  PictureScene p = picture_scenes()[1];
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 3}, {101, 7}, {16384, 1}, {1, 4096}}) {
    const auto renderer = make({width, height, 1});
    const auto image = renderer->render(render::make_frame(
        p.scene, p.particles, 0, render::make_look(p.scene, p.particles, p.by), 1.0 * width / height));
    ASSERT_TRUE(image) << image.error().text();
    EXPECT_EQ(image->width, width);
    EXPECT_EQ(image->height, height);
    EXPECT_EQ(image->pixels.size(), 4u * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  }
  const render::Image expected = draw(frame_of(p));
  for (int samples = 1; samples <= 4; ++samples) {
    const auto image = make({kWidth, kHeight, samples})->render(frame_of(p));
    ASSERT_TRUE(image);
    EXPECT_GT(similarity(*image, expected), 0.85) << samples;  // smoother or rougher, but the same
  }
}

TEST_F(GlRenderer, RefusesSizesThatCanNotBe) {
  for (const render::RenderSettings& settings :
       {render::RenderSettings{0, 10, 1}, {10, 0, 1}, {10, 10, 0}, {10, 10, 5}, {1 << 20, 10, 1}, {16384, 10, 4}}) {
    const auto made = render::make_gl_renderer(settings);
    ASSERT_FALSE(made) << settings.width;
    EXPECT_EQ(made.error().kind, Error::Kind::bad_input);
    EXPECT_THAT(made.error().text(), testing::HasSubstr("size"));
  }
}

// Compares with the stored picture; keeps the drawn picture where they differ.
class StoredPicture : public GlRenderer, public testing::WithParamInterface<PictureScene> {};

render::Image read_png(const std::filesystem::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  auto image = render::decode_png(bytes.str());
  return image ? std::move(*image) : render::Image();
}

void write_png(const std::filesystem::path& file, const render::Image& image) {
  const auto bytes = render::encode_png(image);
  std::ofstream(file, std::ios::binary) << *bytes;
}

TEST_P(StoredPicture, LooksTheSame) {
  const PictureScene& p = GetParam();
  const render::Frame frame = frame_of(p);
  render::Image image = draw(frame);
  if (frame.scale) render::draw_legend(image, *frame.scale);
  render::draw_caption(image, p.name);
  const auto stored = std::filesystem::path(HOOKE_SOURCE_DIR) / "tests/render/images" / (p.name + ".png");
  if (std::getenv("HOOKE_UPDATE_IMAGES") != nullptr) return write_png(stored, image);
  const double alike = similarity(image, read_png(stored));
  RecordProperty("similarity", std::to_string(alike));
  if (alike >= kMostDifferent) return;
  const std::filesystem::path folder = HOOKE_TEST_OUTPUT;
  std::filesystem::create_directories(folder);
  const auto drawn = folder / (p.name + ".png");
  write_png(drawn, image);
  ADD_FAILURE() << "similarity " << alike << " is below " << kMostDifferent << ": compare " << drawn << " with "
                << stored << "; where the new one is right, build the target update_test_images";
}

INSTANTIATE_TEST_SUITE_P(All, StoredPicture, testing::ValuesIn(picture_scenes()), [](const auto& test) {
  std::string name = test.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

// The stored pictures show different scenes: swapped files would be noticed.
TEST(StoredPictures, AreAllDifferent) {
  std::vector<render::Image> images;
  for (const PictureScene& p : picture_scenes()) {
    images.push_back(read_png(std::filesystem::path(HOOKE_SOURCE_DIR) / "tests/render/images" / (p.name + ".png")));
    EXPECT_EQ(images.back().width, kWidth) << p.name;
  }
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_LT(similarity(images[i], images[j]), 0.9) << i << ' ' << j;
  }
}

}  // namespace
}  // namespace hooke::test
