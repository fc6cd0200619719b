// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "hooke/render/visible_spheres.h"

namespace hooke::render {

/// Thickness of the water along the view, m, coarse: deep water looks dark and thin water bright.
struct WaterThickness {
  static constexpr int kCell = 8;  ///< side of a cell, in pixels of the projection's picture

  int columns = 0, rows = 0;
  std::vector<float> meters;  ///< columns * rows, the lowest row first
};

/// The thickness of the spheres that are water; they count as packed at random (0.64 of the volume). The same for any
/// number of threads.
WaterThickness water_thickness(std::span<const Sphere> spheres, const Projection& projection);

}  // namespace hooke::render
