// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "scale.h"

namespace hooke::view {

std::tuple<double, double> default_range(const Scene& scene, const ParticleSet& first, const ColoringInfo& coloring) {
  if (coloring.of_films) {
    const render::ColorScale scale = render::default_scale(scene, first, *coloring.of_films);
    return {scale.low, scale.high};
  }
  const double run = scene.time_step * static_cast<double>(scene.steps);  // of ages
  return {0, run > 0 ? run : 1};
}

}  // namespace hooke::view
