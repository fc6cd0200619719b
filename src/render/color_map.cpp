// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/color_map.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>

#include "hooke/base/assert.h"

namespace hooke::render {

namespace {

constexpr Color kGrey{128, 128, 128};
constexpr std::size_t kColors = 256;

double to_linear(std::uint8_t channel) {
  const double c = channel / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

std::uint8_t to_channel(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

Color to_color(const Oklab& lab) {
  const double l = std::pow(lab.lightness + 0.3963377774 * lab.a + 0.2158037573 * lab.b, 3);
  const double m = std::pow(lab.lightness - 0.1055613458 * lab.a - 0.0638541728 * lab.b, 3);
  const double s = std::pow(lab.lightness - 0.0894841775 * lab.a - 1.2914855480 * lab.b, 3);
  return {to_channel(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          to_channel(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          to_channel(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

double distance(const Oklab& p, const Oklab& q) { return std::hypot(p.lightness - q.lightness, p.a - q.a, p.b - q.b); }

Oklab between(const Oklab& p, const Oklab& q, double share) {
  return {std::lerp(p.lightness, q.lightness, share), std::lerp(p.a, q.a, share), std::lerp(p.b, q.b, share)};
}

Oklab of_hue(double lightness, double chroma, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {lightness, chroma * std::cos(angle), chroma * std::sin(angle)};
}

// Colours at equal distances along a path. The path's corners are colours that screens can show.
std::array<Color, kColors> make_map() {
  const std::array corners{of_hue(0.25, 0.11, 300),  of_hue(0.42, 0.13, 272), of_hue(0.58, 0.10, 225),
                           of_hue(0.72, 0.125, 165), of_hue(0.84, 0.17, 125), of_hue(0.94, 0.16, 105)};
  std::array<double, corners.size()> along{};
  for (std::size_t i = 1; i < corners.size(); ++i) along[i] = along[i - 1] + distance(corners[i - 1], corners[i]);
  std::array<Color, kColors> map;
  std::size_t leg = 1;
  for (std::size_t i = 0; i < kColors; ++i) {
    const double here = along.back() * static_cast<double>(i) / (kColors - 1);
    while (leg + 1 < corners.size() && here > along[leg]) ++leg;
    const double share = (here - along[leg - 1]) / (along[leg] - along[leg - 1]);
    map[i] = to_color(between(corners[leg - 1], corners[leg], share));
  }
  return map;
}

}  // namespace

Color parse_color(const char* text) {
  HOOKE_ASSERT(text != nullptr);
  unsigned value = 0;
  if (std::strlen(text) != 7 || text[0] != '#') return kGrey;
  if (const auto read = std::from_chars(text + 1, text + 7, value, 16); read.ptr != text + 7) return kGrey;
  return {static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8 & 255),
          static_cast<std::uint8_t>(value & 255)};
}

Oklab to_oklab(Color color) {
  const double r = to_linear(color.red), g = to_linear(color.green), b = to_linear(color.blue);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

Color map_color(double value) {
  static const std::array<Color, kColors> map = make_map();
  if (std::isnan(value)) return kGrey;
  return map[static_cast<std::size_t>(std::lround(std::clamp(value, 0.0, 1.0) * (kColors - 1)))];
}

}  // namespace hooke::render
