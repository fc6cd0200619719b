// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "hooke/render/coloring.h"

namespace hooke::run {

/// What a number may be, both ends included.
struct Limits {
  double least;
  double most;
};
constexpr Limits kFramesPerSecond{1e-3, 1e3};
constexpr Limits kFilmSpeed{1e-6, 1e6};

/// How pictures are drawn.
struct PictureArguments {
  int width = 1280;  ///< pixels
  int height = 720;  ///< pixels
  double frames_per_second = 30;  ///< within kFramesPerSecond
  double speed = 1;               ///< simulated seconds a second of film, within kFilmSpeed
  int samples = 2;  ///< squared: the samples per pixel
  render::ColorBy color_by = render::ColorBy::material;
  std::optional<std::array<double, 2>> range;  ///< of the colour map
  bool legend = true;
  bool alpha = false;  ///< whether nothing is drawn behind everything

  double seconds_a_frame() const { return speed / frames_per_second; }  ///< simulated

  friend bool operator==(const PictureArguments&, const PictureArguments&) = default;
};

}  // namespace hooke::run
