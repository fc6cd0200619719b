// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "hooke/render/visible_spheres.h"

namespace hooke {

/// How much water lies behind each other in a picture, m: coarse, for what is deep looks dark and what is thin bright.
struct WaterThickness {
  static constexpr int kCell = 8;  ///< pixels of the projection's picture a cell, along each side

  int columns = 0, rows = 0;
  std::vector<float> meters;  ///< columns * rows, the lowest row first
};

/// Of the spheres that are water, whose volume counts as if packed at random (0.64). The same for any number of
/// threads.
WaterThickness water_thickness(std::span<const Sphere> spheres, const Projection& projection);

}  // namespace hooke
