// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Written by Hooke, read by OpenEXR itself.

#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

#include "hooke/base/random.h"
#include "hooke/render/linear_image.h"

namespace hooke {
namespace {

/// A file in memory.
class Bytes final : public Imf::IStream {
 public:
  explicit Bytes(const std::string& text) : Imf::IStream("picture"), text_(text) {}
  bool read(char to[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (place_ + size > text_.size()) throw std::runtime_error("the file is too short");
    std::memcpy(to, text_.data() + place_, size);
    place_ += size;
    return place_ < text_.size();
  }
  std::uint64_t tellg() override { return place_; }
  void seekg(std::uint64_t to) override { place_ = to; }

 private:
  const std::string& text_;
  std::size_t place_ = 0;
};

// From dark to far brighter than white.
render::LinearImage bright_noise(int width, int height) {
  render::LinearImage image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const auto u = uniform4(1, i, 0);
    image.pixels[i] = static_cast<float>(u[0] * std::pow(2.0, 20 * u[1] - 10));
  }
  return image;
}

TEST(Exr, EveryPixelComesBackWithElevenBits) {
  for (const auto& [width, height] : {std::pair{1, 1}, {17, 5}, {1, 300}, {640, 2}}) {
    render::LinearImage image = bright_noise(width, height);
    image.pixels[0] = 1e6f;  // more than a half float holds
    const auto bytes = render::encode_exr(image);
    ASSERT_TRUE(bytes) << bytes.error().text();
    Bytes stream(*bytes);
    Imf::RgbaInputFile file(stream);
    ASSERT_EQ(file.channels(), Imf::WRITE_RGBA);
    ASSERT_EQ(file.dataWindow().max, Imath::V2i(width - 1, height - 1));
    std::vector<Imf::Rgba> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    file.setFrameBuffer(pixels.data(), 1, static_cast<std::size_t>(width));
    file.readPixels(0, height - 1);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const float* expected = image.at(x, y);
        const Imf::Rgba& found =
            pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
        const float read[] = {found.r, found.g, found.b, found.a};
        for (int c = 0; c < 4; ++c) {
          if (expected[c] > 65504) {
            EXPECT_EQ(read[c], 65504);
          } else {
            EXPECT_NEAR(read[c], expected[c], expected[c] / 2048 + 1e-7) << x << ' ' << y << ' ' << c;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace hooke
