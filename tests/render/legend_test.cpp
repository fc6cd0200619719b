// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/render/legend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "hooke/render/color_map.h"

namespace hooke {
namespace {

int changed(const render::Image& image, int left, int top, int right, int bottom) {
  int n = 0;
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) n += image.at(x, y)[0] + image.at(x, y)[1] + image.at(x, y)[2] > 0 ? 1 : 0;
  }
  return n;
}

TEST(Legend, ShowsTheColourMapInTheLowerRightCorner) {
  render::Image image(640, 360);
  render::draw_legend(image, {render::ColorBy::speed, 0, 8});
  EXPECT_EQ(changed(image, 0, 0, 640, 300), 0);
  EXPECT_EQ(changed(image, 0, 300, 450, 360), 0);
  // Some row holds the map from end to end.
  int rows = 0;
  for (int y = 300; y < 360; ++y) {
    int alike = 0;
    for (int k = 1; k < 20; ++k) {
      const render::Color expected = render::map_color(k / 20.0);
      const std::uint8_t* p = image.at(478 + 144 * k / 20, y);  // 16 lines of text wide
      alike += std::abs(p[0] - expected.red) + std::abs(p[1] - expected.green) + std::abs(p[2] - expected.blue) < 12;
    }
    rows += alike == 19 ? 1 : 0;
  }
  EXPECT_GE(rows, 3);
  EXPECT_GT(changed(image, 470, 340, 640, 360), 30);  // numbers
}

TEST(Legend, OtherValuesHaveOtherNumbers) {
  render::Image a(640, 360), b(640, 360), c(640, 360);
  render::draw_legend(a, {render::ColorBy::speed, 0, 8});
  render::draw_legend(b, {render::ColorBy::speed, 0, 9});
  render::draw_legend(c, {render::ColorBy::height, 0, 8});
  EXPECT_NE(a.pixels, b.pixels);
  EXPECT_NE(a.pixels, c.pixels);
}

TEST(Legend, AnyScaleAndAnySize) {
  for (const auto& [low, high] :
       {std::pair{1e17, 1e17 + 16}, {-1e-300, 1e-300}, {0.0, 5e-324}, {-1e300, 1e300}, {1e9, 1e9 + 1e-6}}) {
    render::Image image(320, 180);
    render::draw_legend(image, {render::ColorBy::id, low, high});
    EXPECT_GT(changed(image, 0, 0, 320, 180), 100) << low;
  }
  for (const auto& [width, height] : {std::pair{1, 1}, {3000, 1}, {1, 3000}, {7, 5}}) {
    render::Image image(width, height);
    render::draw_legend(image, {render::ColorBy::speed, 0, 1});
    render::draw_caption(image, "0.00 s");
  }
}

TEST(Caption, IsInTheLowerLeftCorner) {
  render::Image image(640, 360);
  render::draw_caption(image, "1.25 s");
  EXPECT_GT(changed(image, 0, 330, 100, 360), 30);
  EXPECT_EQ(changed(image, 100, 0, 640, 360), 0);
  EXPECT_EQ(changed(image, 0, 0, 640, 320), 0);
}

}  // namespace
}  // namespace hooke
