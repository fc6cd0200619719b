// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "support/similarity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hooke/base/random.h"

namespace hooke::test {
namespace {

// Soft waves of different lengths: edges, slopes and flat parts.
render::Image waves() {
  render::Image image(96, 64);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double wave = std::sin(0.15 * x * (c + 1)) * std::cos(0.11 * y + c);
        image.at(x, y)[c] = static_cast<std::uint8_t>(128 + 80 * wave);
      }
    }
  }
  return image;
}

template <class Change>
render::Image changed(const Change& change) {
  render::Image image = waves();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        image.at(x, y)[c] = static_cast<std::uint8_t>(std::clamp<double>(change(x, y, c, image.at(x, y)[c]), 0, 255));
      }
    }
  }
  return image;
}

constexpr double kThreshold = 0.97;  // of the image tests

TEST(Similarity, IsOneForTheSame) {
  EXPECT_DOUBLE_EQ(similarity(waves(), waves()), 1);
  const render::Image flat(16, 16);
  EXPECT_DOUBLE_EQ(similarity(flat, flat), 1);
}

TEST(Similarity, ForgivesTheLastBit) {
  EXPECT_GT(similarity(waves(), changed([](int x, int y, int c, double v) {
                         return v +
                                std::round(2 * uniform4(1, static_cast<std::uint64_t>(x + 100 * y), 0)[0] - 1 + 0 * c);
                       })),
            0.99);
}

TEST(Similarity, FallsWithNoiseShiftAndBrightness) {
  const render::Image original = waves();
  const render::Image noisy = changed([](int x, int y, int, double v) {
    return v + 60 * (uniform4(1, static_cast<std::uint64_t>(x + 100 * y), 0)[0] - 0.5);
  });
  const render::Image shifted =
      changed([&](int x, int y, int c, double) { return original.at(std::min(x + 3, 95), y)[c]; });
  const render::Image brighter = changed([](int, int, int, double v) { return v + 60; });
  const render::Image inverse = changed([](int, int, int, double v) { return 255 - v; });
  for (const render::Image* other : {&noisy, &shifted, &brighter, &inverse})
    EXPECT_LT(similarity(original, *other), kThreshold);
  EXPECT_LT(similarity(original, inverse), 0);
}

TEST(Similarity, SeesOneColourAndOneCorner) {
  const render::Image red =
      changed([](int x, int y, int c, double v) { return c == 0 && x < 32 && y < 32 ? 255 - v : v; });
  EXPECT_LT(similarity(waves(), red), kThreshold);
}

TEST(Similarity, IsSymmetric) {
  const render::Image other = changed([](int x, int, int, double v) { return v + x; });
  EXPECT_DOUBLE_EQ(similarity(waves(), other), similarity(other, waves()));
}

TEST(Similarity, IsNoneWhereSizesDiffer) {
  EXPECT_EQ(similarity(render::Image(16, 16), render::Image(16, 17)), 0);
  EXPECT_EQ(similarity(render::Image(4, 4), render::Image(4, 4)), 0);
}

}  // namespace
}  // namespace hooke::test
