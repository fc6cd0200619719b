// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace hooke::render {

/// A colour as screens take it: sRGB, 8 bits a channel.
struct Color {
  std::uint8_t red = 0, green = 0, blue = 0;

  friend bool operator==(const Color&, const Color&) = default;
};

/// "#rrggbb" as a colour; grey where `text` is no colour.
Color parse_color(const char* text);

/// Lightness, green to red and blue to yellow, in the space Oklab (B. Ottosson, "A perceptual color space for image
/// processing", 2020), where equal distances look equally different.
struct Oklab {
  double lightness = 0, a = 0, b = 0;
};
Oklab to_oklab(Color color);

/// A perceptually even map from dark violet over blue and green to bright yellow: its lightness only rises, and equal
/// steps of the value look equal. `value` in [0, 1], clamped; NaN is grey.
Color map_color(double value);

}  // namespace hooke::render
