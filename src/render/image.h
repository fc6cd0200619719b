// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/base/expected.h"

namespace hooke::render {

/// A picture: 8 bits for each of red, green, blue (sRGB) and alpha, which counts only where a picture is written with
/// it; the first row is the top.
struct Image {
  static constexpr std::size_t kChannels = 4;

  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  ///< kChannels * width * height

  Image() = default;
  Image(int w, int h)
      : width(w),
        height(h),
        pixels(kChannels * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {
    HOOKE_ASSERT(w >= 0 && h >= 0, w, h);
  }

  /// The pixel in column x (< width) of row y (< height).
  std::uint8_t* at(int x, int y) {
    HOOKE_ASSERT(x >= 0 && x < width && y >= 0 && y < height, x, y, width, height);
    return pixels.data() +
           kChannels * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
  const std::uint8_t* at(int x, int y) const { return const_cast<Image*>(this)->at(x, y); }
};

/// The bytes of a PNG file, 8 bits a channel; with alpha (not multiplied into the colours) or without.
Expected<std::string> encode_png(const Image& image, bool alpha = false);
/// The picture in the bytes of a PNG file of any kind; bad_input where the bytes are no PNG file.
Expected<Image> decode_png(const std::string& bytes);

}  // namespace hooke::render
