// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "hooke/render/coloring.h"

namespace hooke::run {

/// How pictures are drawn.
struct PictureArguments {
  int width = 1280;  ///< pixels
  int height = 720;  ///< pixels
  double frames_per_second = 30;
  double speed = 1;  ///< simulated seconds a second of film
  int samples = 2;  ///< squared: the samples per pixel
  render::ColorBy color_by = render::ColorBy::material;
  std::optional<std::array<double, 2>> range;  ///< of the colour map
  bool legend = true;
  bool alpha = false;  ///< whether nothing is drawn behind everything

  double seconds_a_frame() const { return speed / frames_per_second; }  ///< simulated

  friend bool operator==(const PictureArguments&, const PictureArguments&) = default;
};

}  // namespace hooke::run
