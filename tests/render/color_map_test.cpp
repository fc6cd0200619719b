// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/render/color_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>
#include <vector>

namespace hooke::render {

// How GoogleTest shows it.
static void PrintTo(const Color& c, std::ostream* out) {
  *out << '(' << +c.red << ", " << +c.green << ", " << +c.blue << ')';
}

}  // namespace hooke::render

namespace hooke {
namespace {

double distance(render::Color p, render::Color q) {
  const render::Oklab a = render::to_oklab(p), b = render::to_oklab(q);
  return std::hypot(a.lightness - b.lightness, a.a - b.a, a.b - b.b);
}

// 8 bits a channel round a colour by up to 0.004 here, so steps are compared over a sixteenth of the map.
constexpr int kSteps = 16;
render::Color step(int k) { return render::map_color(static_cast<double>(k) / kSteps); }

TEST(ColorMap, LightnessRises) {
  for (int k = 1; k <= 64; ++k) {
    EXPECT_GT(render::to_oklab(render::map_color(k / 64.0)).lightness,
              render::to_oklab(render::map_color((k - 1) / 64.0)).lightness)
        << k;
  }
}

TEST(ColorMap, EqualStepsLookEqual) {
  double sum = 0;
  for (int k = 1; k <= kSteps; ++k) sum += distance(step(k - 1), step(k));
  for (int k = 1; k <= kSteps; ++k) {
    const double share = distance(step(k - 1), step(k)) / (sum / kSteps);
    EXPECT_GT(share, 0.85) << k;
    EXPECT_LT(share, 1.15) << k;
  }
}

TEST(ColorMap, GoesFromDarkVioletToBrightYellow) {
  const render::Color first = render::map_color(0), last = render::map_color(1);
  EXPECT_LT(render::to_oklab(first).lightness, 0.3);
  EXPECT_GT(first.blue, first.red);
  EXPECT_GT(first.red, first.green);
  EXPECT_GT(render::to_oklab(last).lightness, 0.9);
  EXPECT_GT(last.red, 220);
  EXPECT_GT(last.green, 220);
  EXPECT_LT(last.blue, 150);
}

TEST(ColorMap, ClampsAndShowsNoNumberAsGrey) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(render::map_color(-0.1), render::map_color(0));
  EXPECT_EQ(render::map_color(-infinity), render::map_color(0));
  EXPECT_EQ(render::map_color(1.1), render::map_color(1));
  EXPECT_EQ(render::map_color(infinity), render::map_color(1));
  EXPECT_EQ(render::map_color(std::numeric_limits<double>::quiet_NaN()), (render::Color{128, 128, 128}));
}

// Values from the article that defines the space.
TEST(ColorMap, OklabOfKnownColors) {
  struct Known {
    render::Color color;
    render::Oklab lab;
  };
  for (const Known& known :
       {Known{{255, 255, 255}, {1, 0, 0}}, Known{{0, 0, 0}, {0, 0, 0}}, Known{{255, 0, 0}, {0.628, 0.2249, 0.1258}},
        Known{{0, 255, 0}, {0.8664, -0.2339, 0.1795}}, Known{{0, 0, 255}, {0.452, -0.0325, -0.3115}}}) {
    const render::Oklab lab = render::to_oklab(known.color);
    EXPECT_NEAR(lab.lightness, known.lab.lightness, 5e-4) << +known.color.red << ' ' << +known.color.green;
    EXPECT_NEAR(lab.a, known.lab.a, 5e-4) << +known.color.red << ' ' << +known.color.green;
    EXPECT_NEAR(lab.b, known.lab.b, 5e-4) << +known.color.red << ' ' << +known.color.green;
  }
}

TEST(ParseColor, ReadsSixDigits) {
  EXPECT_EQ(render::parse_color("#2f7fd6"), (render::Color{0x2f, 0x7f, 0xd6}));
  EXPECT_EQ(render::parse_color("#FF00aB"), (render::Color{255, 0, 0xab}));
  EXPECT_EQ(render::parse_color("#000000"), (render::Color{0, 0, 0}));
}

TEST(ParseColor, IsGreyWhereThereIsNone) {
  for (const char* text :
       {"", "#", "red", "2f7fd6", "#2f7fd", "#2f7fd60", "#2f7fdg", "#-12345", "# 12345", "#0x1234"}) {
    EXPECT_EQ(render::parse_color(text), (render::Color{128, 128, 128})) << text;
  }
}

}  // namespace
}  // namespace hooke
