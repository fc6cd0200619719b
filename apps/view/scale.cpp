// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "scale.h"

#include "hooke/render/coloring.h"

namespace hooke::view {

std::tuple<double, double> default_range(const Scene& scene, const ParticleSet& first, Coloring by) {
  const auto like_films = [&](render::ColorBy what) {
    const render::ColorScale scale = render::default_scale(scene, first, what);
    return std::tuple{scale.low, scale.high};
  };
  switch (by) {
    case Coloring::material:
      return like_films(render::ColorBy::material);
    case Coloring::speed:
      return like_films(render::ColorBy::speed);
    case Coloring::height:
      return like_films(render::ColorBy::height);
    case Coloring::pressure:
      return like_films(render::ColorBy::pressure);
    case Coloring::contacts:
      return like_films(render::ColorBy::contacts);
    case Coloring::id:
      return like_films(render::ColorBy::id);
    case Coloring::age:
      break;
  }
  const double run = scene.time_step * static_cast<double>(scene.steps);
  return {0, run > 0 ? run : 1};
}

}  // namespace hooke::view
