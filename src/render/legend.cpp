// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/legend.h"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "hooke/base/assert.h"
#include "hooke/render/color_map.h"

namespace hooke::render {

namespace {

// Draws on an image. Cairo wants pixels as blue, green, red, so red and blue are swapped now and back at the end.
class Canvas {
 public:
  explicit Canvas(Image& image)
      : image_(image),
        surface_(
            (swap_red_and_blue(), cairo_image_surface_create_for_data(image.pixels.data(), CAIRO_FORMAT_RGB24,
                                                                      image.width, image.height, 4 * image.width))),
        context_(cairo_create(surface_)) {
    cairo_select_font_face(context_, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context_, unit() * 1.1);
  }
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;
  ~Canvas() {
    cairo_destroy(context_);
    cairo_surface_flush(surface_);
    cairo_surface_destroy(surface_);
    swap_red_and_blue();
  }

  cairo_t* context() const { return context_; }
  /// A length that grows with the picture, about the height of a line of text, pixels.
  double unit() const { return std::max(9.0, image_.height / 45.0); }

  double width(const std::string& words) const {
    cairo_text_extents_t size;
    cairo_text_extents(context_, words.c_str(), &size);
    return size.x_advance;
  }

  enum class Align { left, center };
  /// White text with a dark rim, legible on any background; `x`, `y`: on the base line.
  void text(const std::string& words, double x, double y, Align align) const {
    const double shift = align == Align::left ? 0 : 0.5 * width(words);
    cairo_move_to(context_, x - shift, y);
    cairo_text_path(context_, words.c_str());
    cairo_set_source_rgba(context_, 0.04, 0.06, 0.09, 0.75);
    cairo_set_line_width(context_, unit() * 0.18);
    cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke_preserve(context_);
    cairo_set_source_rgb(context_, 0.95, 0.96, 0.97);
    cairo_fill(context_);
  }

 private:
  void swap_red_and_blue() const {
    for (std::size_t i = 0; i < image_.pixels.size(); i += Image::kChannels) {
      std::swap(image_.pixels[i], image_.pixels[i + 2]);
    }
  }

  Image& image_;
  cairo_surface_t* surface_;
  cairo_t* context_;
};

// A round step that divides the range into four to ten.
double round_step(double range) {
  const double power = std::pow(10, std::floor(std::log10(range / 4)));
  for (const double step : {5.0, 2.0}) {
    if (range / (step * power) >= 4) return step * power;
  }
  return power;
}

// The exponent of ten, a multiple of 3, by which to divide numbers up to `most` to make them short; 0: none.
int thousands(double most) {
  if (!(most >= 1e4 || (most > 0 && most < 1e-2))) return 0;
  return 3 * static_cast<int>(std::floor(std::log10(most) / 3));
}

// "height (10\u2076 m)"
std::string title_text(ColorBy by, int power) {
  static const char* const kDigits[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                        "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  const auto [quantity, unit] = title(by);
  std::string in_brackets = unit;
  if (power != 0) {
    std::string exponent = power < 0 ? "\u207b" : "";
    for (const char digit : std::to_string(std::abs(power))) exponent += kDigits[digit - '0'];
    in_brackets = "10" + exponent + (*unit ? " " : "") + unit;
  }
  return in_brackets.empty() ? quantity : fmt::format("{} ({})", quantity, in_brackets);
}

}  // namespace

void draw_legend(Image& image, const ColorScale& scale) {
  HOOKE_ASSERT(scale.high > scale.low, scale.low, scale.high);
  const Canvas canvas(image);
  cairo_t* const c = canvas.context();
  const double unit = canvas.unit();
  const double width = std::min(16 * unit, 0.45 * image.width), height = 0.7 * unit;
  const double left = image.width - width - 2 * unit, top = image.height - 3.1 * unit;
  constexpr int kStripes = 256;
  for (int i = 0; i < kStripes; ++i) {
    const Color color = map_color((i + 0.5) / kStripes);
    cairo_set_source_rgb(c, color.red / 255.0, color.green / 255.0, color.blue / 255.0);
    cairo_rectangle(c, left + width * i / kStripes, top, width / kStripes + 0.6, height);
    cairo_fill(c);
  }
  cairo_set_source_rgba(c, 0.95, 0.96, 0.97, 0.8);
  cairo_set_line_width(c, std::max(1.0, unit / 14));
  cairo_rectangle(c, left, top, width, height);
  cairo_stroke(c);
  const int power = thousands(std::max(std::abs(scale.low), std::abs(scale.high)));
  canvas.text(title_text(scale.by, power), left, top - 0.55 * unit, Canvas::Align::left);
  const double step = round_step(scale.high - scale.low);
  const double first = std::ceil(scale.low / step - 1e-9);
  constexpr int kMostTicks = 11;
  const auto number = [&](double k) {
    return fmt::format("{:.4g}", k * step == 0 ? 0 : k * step * std::pow(10.0, -power));
  };
  // Where numbers would run into each other, only every second or third tick, and so on, has one.
  double widest = 0;
  for (int tick = 0; tick < kMostTicks; ++tick) widest = std::max(widest, canvas.width(number(first + tick)));
  const double apart = width * step / (scale.high - scale.low);
  const double every = std::clamp(std::ceil((widest + 0.4 * unit) / apart), 1.0, 1.0 * kMostTicks);
  for (int tick = 0; tick < kMostTicks; ++tick) {
    const double k = first + tick;
    if (!(k * step <= scale.high + 1e-9 * step)) break;
    const double x = left + width * (k * step - scale.low) / (scale.high - scale.low);
    cairo_set_source_rgba(c, 0.95, 0.96, 0.97, 0.8);
    cairo_move_to(c, x, top + height);
    cairo_line_to(c, x, top + height + 0.3 * unit);
    cairo_stroke(c);
    if (std::fmod(k, every) == 0) canvas.text(number(k), x, top + height + 1.5 * unit, Canvas::Align::center);
  }
}

void draw_caption(Image& image, const std::string& text) {
  const Canvas canvas(image);
  canvas.text(text, 1.4 * canvas.unit(), image.height - 1.4 * canvas.unit(), Canvas::Align::left);
}

}  // namespace hooke::render
