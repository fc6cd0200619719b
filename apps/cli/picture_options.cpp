// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "picture_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "choice.h"

namespace hooke::cli {
namespace {

// Parses "1280x720" into width and height.
std::string parse_size(const std::string& text, PictureArguments& picture) {
  int width = 0, height = 0;
  char rest = 0;
  constexpr int kMost = 16384;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 1 || height < 1 || width > kMost ||
      height > kMost) {
    return fmt::format("{} is no size such as 1280x720, from 1x1 to {}x{}", text, kMost, kMost);
  }
  picture.width = width;
  picture.height = height;
  return {};
}

// CLI::Range accepts NaN.
std::string not_nan(const std::string& text) {
  return std::isnan(std::strtod(text.c_str(), nullptr)) ? text + " is no number" : "";
}

}  // namespace

void add_picture_options(CLI::App& command, PictureArguments& picture) {
  command
      .add_option_function<std::string>(
          "--size", [](const std::string&) {}, "of the picture, pixels (default: 1280x720)")
      ->option_text("WxH")
      ->check([&picture](const std::string& text) { return parse_size(text, picture); });
  command.add_option("--fps", picture.frames_per_second, "frames a second of film (default: 30)")
      ->option_text("F")
      ->check(CLI::Range(run::kFramesPerSecond.least, run::kFramesPerSecond.most) & CLI::Validator(not_nan, ""));
  command
      .add_option("--speed", picture.speed,
                  "simulated seconds that a second of film shows: 0.25 is slow motion (default: 1)")
      ->option_text("X")
      ->check(CLI::Range(run::kFilmSpeed.least, run::kFilmSpeed.most) & CLI::Validator(not_nan, ""));
  std::vector<std::pair<std::string, render::ColorBy>> names;
  for (const render::ColorByName& name : render::kColorByNames) names.emplace_back(name.name, name.by);
  add_choice(command, "--color-by", picture.color_by, names,
             "material (default), speed, height, pressure, contacts or id; all but material with a legend")
      ->option_text("WHAT");
  command
      .add_option_function<std::vector<double>>(
          "--color-range",
          [&picture](const std::vector<double>& ends) {
            if (!(ends[0] < ends[1]) || !std::isfinite(ends[1] - ends[0])) {
              throw CLI::ValidationError("--color-range", "LOW must be below HIGH");
            }
            picture.range = {ends[0], ends[1]};
          },
          "values at the two ends of the colours (default: from the scene)")
      ->option_text("LOW HIGH")
      ->expected(2);
  command.add_option("--samples", picture.samples, "samples a pixel, along each side (default: 2)")
      ->option_text("N")
      ->check(CLI::Range(1, 4));
  command.add_flag_callback("--no-legend", [&picture] { picture.legend = false; }, "leave out the time and the legend");
}

}  // namespace hooke::cli
