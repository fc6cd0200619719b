// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include "hooke/base/random.h"
#include "hooke/render/image.h"

namespace hooke {
namespace {

render::Image noise(int width, int height) {
  render::Image image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = static_cast<std::uint8_t>(256 * uniform4(1, i, 0)[0]);
  }
  return image;
}

TEST(Png, EveryPixelComesBack) {
  for (const auto& [width, height] : {std::pair{1, 1}, {17, 5}, {1, 300}, {640, 2}}) {
    const render::Image image = noise(width, height);
    const auto bytes = render::encode_png(image);
    ASSERT_TRUE(bytes) << bytes.error().text();
    const auto back = render::decode_png(*bytes);
    ASSERT_TRUE(back) << back.error().text();
    ASSERT_EQ(back->width, width);
    ASSERT_EQ(back->height, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        for (int c = 0; c < 3; ++c) ASSERT_EQ(back->at(x, y)[c], image.at(x, y)[c]) << x << ' ' << y << ' ' << c;
      }
    }
  }
}

TEST(Png, IsAnRgbFileOfEightBits) {
  const auto bytes = render::encode_png(noise(3, 2));
  ASSERT_TRUE(bytes);
  EXPECT_EQ(bytes->substr(1, 3), "PNG");
  EXPECT_EQ(bytes->substr(12, 4), "IHDR");
  EXPECT_EQ(bytes->substr(16, 10), std::string("\0\0\0\3\0\0\0\2\x08\x02", 10));  // width, height, 8 bits, RGB
}

TEST(Png, BrokenBytesAreAnError) {
  auto bytes = render::encode_png(noise(30, 20));
  ASSERT_TRUE(bytes);
  for (const std::string& broken :
       {std::string(), std::string("no picture"), bytes->substr(0, 20), bytes->substr(0, bytes->size() / 2)}) {
    const auto read = render::decode_png(broken);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().kind, Error::Kind::bad_input);
  }
}

}  // namespace
}  // namespace hooke
