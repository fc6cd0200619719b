// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/default_warnings.h"

#include <fmt/format.h>

#include <cmath>
#include <variant>

#include "hooke/scene/json_path.h"

namespace hooke::scene {

std::vector<Finding> default_warnings(const Scene& scene) {
  std::vector<Finding> warnings;
  const bool cloths = scene.structure && !scene.structure->surfaces.empty();
  for (std::size_t i = 0; cloths && i < scene.fields.size(); ++i) {
    const auto* wind = std::get_if<Wind>(&scene.fields[i].law);
    if (wind == nullptr || wind->area_drag > 0) continue;
    warnings.push_back({join_path(join_path(join_path("fields", i), "wind"), "area_drag"),
                        "is 0: the wind drags the particles of cloths along but does not press on their triangles; a "
                        "flag needs about 4 kg/(m^2 s)"});
  }
  for (const Material& material : scene.materials) {
    if (!material.is_of_particles() || !material.interacts) continue;
    if (material.surface.tension > 0 || !std::isinf(material.surface.friction)) continue;
    warnings.push_back({join_path(join_path("materials", material.name), "friction"),
                        "is left out: the tangential force of these grains has no limit, so they stick to each other "
                        "where they slide fast; sand has about 0.5"});
  }
  return warnings;
}

}  // namespace hooke::scene
