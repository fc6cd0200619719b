// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/render/coloring.h"

#include "hooke/render/action.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>

namespace hooke {
namespace {

// Two particles that touch on the floor of a tank, and one that falls.
struct Sample {
  Scene scene;
  ParticleSet particles;

  Sample() {
    scene.gravity = {0, 0, -10};
    scene.domain = {{1, 2, 3}, {5, 8, 13}};
    scene.materials = {{"sand", 0.5, 2, {1000, 0, 0}, 0, ""}};
    particles.resize(3);
    particles.id = {3, 8, 12};
    particles.position = {{2, 4, 3.6}, {2.9, 4, 3.6}, {3, 6, 5}};
    particles.velocity = {{0, 0, 0}, {0, 0, 0}, {2, -3, -6}};
  }
};

TEST(ColorValues, AreTheQuantities) {
  const Sample s;
  const Box3d action = render::action_box(s.scene, s.particles);
  const auto values = [&](render::ColorBy by) { return render::color_values(s.scene, s.particles, 0, action, by); };
  EXPECT_TRUE(values(render::ColorBy::material).empty());
  EXPECT_EQ(values(render::ColorBy::speed), (std::vector<double>{0, 0, 7}));
  EXPECT_EQ(values(render::ColorBy::id), (std::vector<double>{3, 8, 12}));
  EXPECT_EQ(values(render::ColorBy::contacts), (std::vector<double>{1, 1, 0}));
  const auto height = values(render::ColorBy::height);
  ASSERT_EQ(height.size(), 3u);
  EXPECT_NEAR(height[0], 0.6, 1e-12);  // above the floor, which is at z = 3
  EXPECT_NEAR(height[2], 2, 1e-12);
  const auto pressure = values(render::ColorBy::pressure);
  ASSERT_EQ(pressure.size(), 3u);
  EXPECT_GT(pressure[0], 0);
  EXPECT_NEAR(pressure[0], pressure[1], 1e-9 * pressure[0]);
  EXPECT_EQ(pressure[2], 0);
}

TEST(ColorValues, HeightIsAgainstGravity) {
  Sample s;
  s.scene.gravity = {0, 0, 10};
  const auto height =
      render::color_values(s.scene, s.particles, 0, render::action_box(s.scene, s.particles), render::ColorBy::height);
  ASSERT_EQ(height.size(), 3u);
  EXPECT_NEAR(height[0], 13 - 3.6, 1e-12);
}

TEST(DefaultScale, SuitsTheRun) {
  const Sample s;
  const double reach = 1.15 * 2.5;  // a bit above the highest particle
  const auto high = [&](render::ColorBy by) {
    const render::ColorScale scale = render::default_scale(s.scene, s.particles, by);
    EXPECT_EQ(scale.by, by);
    EXPECT_EQ(scale.low, 0);
    return scale.high;
  };
  EXPECT_NEAR(high(render::ColorBy::speed), std::sqrt(2 * 10 * reach), 1e-12);
  EXPECT_NEAR(high(render::ColorBy::height), reach, 1e-12);
  EXPECT_NEAR(high(render::ColorBy::pressure), 2 * 3 * 2 * 10.0 / (4 * 6), 1e-12);  // 2 n m g / area
  EXPECT_EQ(high(render::ColorBy::contacts), 12);
  EXPECT_EQ(high(render::ColorBy::id), 12);
}

TEST(DefaultScale, TheFastestParticleIsOnTheSpeedScale) {
  Sample s;
  s.particles.velocity[1] = {0, 30, 40};
  EXPECT_EQ(render::default_scale(s.scene, s.particles, render::ColorBy::speed).high, 50);
}

TEST(DefaultScale, HasTwoEndsWhateverTheScene) {
  Sample s;
  s.scene.gravity = {0, 0, 0};
  for (const ParticleSet& particles : {ParticleSet{}, s.particles}) {
    for (const render::ColorByName& name : render::kColorByNames) {
      const render::ColorScale scale = render::default_scale(s.scene, particles, name.by);
      EXPECT_GT(scale.high, scale.low) << name.name;
      EXPECT_TRUE(std::isfinite(scale.high)) << name.name;
    }
  }
}

TEST(ColorByNames, AreAllDifferentAndAllButMaterialHaveATitle) {
  std::set<std::string> names;
  for (const render::ColorByName& name : render::kColorByNames) {
    names.insert(name.name);
    EXPECT_EQ(std::strlen(title(name.by).quantity) == 0, name.by == render::ColorBy::material) << name.name;
  }
  EXPECT_EQ(names.size(), std::size(render::kColorByNames));
}

}  // namespace
}  // namespace hooke
