// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/render/water_thickness.h"

#include <gtest/gtest.h>
#include <cmath>
#include <numbers>

#include "hooke/base/random.h"
#include "hooke/base/threads.h"

namespace hooke {
namespace {

constexpr int kColumns = 20, kRows = 12;

// Looks along -z; a cell is a metre.
render::Projection from_above() {
  render::Projection view =
      render::project({{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 35}, kColumns * render::WaterThickness::kCell,
                      kRows * render::WaterThickness::kCell);
  view.parallel = true;
  view.scale = render::WaterThickness::kCell;
  view.nearest = 0;
  return view;
}

// 64 balls of radius 0.1 m in every cubic metre of a slab over the whole picture, `depth` metres deep.
std::vector<render::Sphere> slab(int depth, std::uint8_t foam) {
  std::vector<render::Sphere> spheres;
  for (int z = 0; z < 4 * depth; ++z) {
    for (int y = -2 * kRows; y < 2 * kRows; ++y) {
      for (int x = -2 * kColumns; x < 2 * kColumns; ++x) {
        const auto at = [](int k) { return 0.25f * static_cast<float>(k) + 0.125f; };
        spheres.push_back({at(x), at(y), -at(z), 0.1f, {}, foam});
      }
    }
  }
  return spheres;
}

TEST(WaterThickness, IsTheDepthOfWhatIsPackedAtRandom) {
  // A frame's water spheres are larger by a quarter than the particles; the particles fill this share of a metre.
  const double own = 64 * 4 * std::numbers::pi / 3 * std::pow(0.1 / 1.25, 3);
  for (const int depth : {1, 3}) {
    const render::WaterThickness thickness = render::water_thickness(slab(depth, 1), from_above());
    EXPECT_EQ(thickness.columns, kColumns);
    EXPECT_EQ(thickness.rows, kRows);
    ASSERT_EQ(thickness.meters.size(), static_cast<std::size_t>(kColumns * kRows));
    for (const float meters : thickness.meters) EXPECT_NEAR(meters, depth * own / 0.64, 1e-3 * depth);
  }
}

TEST(WaterThickness, OnlyWaterBeforeTheEyeCounts) {
  auto spheres = slab(1, 0);
  for (const float meters : render::water_thickness(spheres, from_above()).meters) EXPECT_EQ(meters, 0);
  for (render::Sphere& sphere : spheres) {
    sphere.foam = 200;
    sphere.z = 11;
  }
  for (const float meters : render::water_thickness(spheres, from_above()).meters) EXPECT_EQ(meters, 0);
  EXPECT_EQ(render::water_thickness({}, from_above()).meters.size(), static_cast<std::size_t>(kColumns * kRows));
}

TEST(WaterThickness, AnyNumberOfThreadsGivesTheSame) {
  auto spheres = slab(2, 1);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    spheres[i].radius *= static_cast<float>(0.5 + uniform4(1, i, 0)[0]);
  }
  const auto expected = render::water_thickness(spheres, from_above()).meters;
  for (const int threads : {1, 2, 3, 8}) {
    Threads(threads).run(
        [&] { EXPECT_EQ(render::water_thickness(spheres, from_above()).meters, expected) << threads; });
  }
}

}  // namespace
}  // namespace hooke
