// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/base/expected.h"

namespace hooke::render {

/// A picture in linear light: red, green and blue (primaries of sRGB; 1 is the white of an Image, what is brighter is
/// above 1), multiplied by alpha, and alpha; the first row is the top.
struct LinearImage {
  static constexpr std::size_t kChannels = 4;

  int width = 0;
  int height = 0;
  std::vector<float> pixels;  ///< kChannels * width * height, >= 0

  LinearImage() = default;
  LinearImage(int w, int h)
      : width(w),
        height(h),
        pixels(kChannels * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {
    HOOKE_ASSERT(w >= 0 && h >= 0, w, h);
  }

  /// The pixel in column x (< width) of row y (< height).
  float* at(int x, int y) {
    HOOKE_ASSERT(x >= 0 && x < width && y >= 0 && y < height, x, y, width, height);
    return pixels.data() +
           kChannels * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
  const float* at(int x, int y) const { return const_cast<LinearImage*>(this)->at(x, y); }
};

/// Whether this build writes OpenEXR files.
bool has_openexr();
/// The bytes of an OpenEXR file: channels R, G, B, A in half floats, ZIP compression. bad_input in a build without
/// OpenEXR.
Expected<std::string> encode_exr(const LinearImage& image);

}  // namespace hooke::render
