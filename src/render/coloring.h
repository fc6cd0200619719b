// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/render/camera.h"
#include "hooke/render/color_map.h"

namespace hooke::render {

/// What the colour of a particle tells.
enum class ColorBy {
  material,  ///< its material's own colour; water that is fast or thin turns white
  speed,     ///< |v|, m/s
  height,    ///< above the floor of the scene's action, against gravity, m
  pressure,  ///< of its contacts, Pa (core/contacts.h)
  contacts,  ///< their number
  id,        ///< shows where each particle came from
};

/// Every ColorBy with its name on the command line.
struct ColorByName {
  const char* name;
  ColorBy by;
};
inline constexpr ColorByName kColorByNames[] = {
    {"material", ColorBy::material}, {"speed", ColorBy::speed},       {"height", ColorBy::height},
    {"pressure", ColorBy::pressure}, {"contacts", ColorBy::contacts}, {"id", ColorBy::id},
};

/// A quantity and the values at the two ends of its colour map. One scale holds for all pictures of a film.
struct ColorScale {
  ColorBy by = ColorBy::material;
  double low = 0;
  double high = 1;  ///< > low
};

/// What the legend says: "speed", "m/s"; both empty for materials, no unit for counts.
struct ColorTitle {
  const char* quantity;
  const char* unit;
};
ColorTitle title(ColorBy by);

/// The colour of each material's particles: its own, or one of a palette by its index.
std::vector<Color> material_colors(const Scene& scene);

/// A scale that suits a whole run, from its scene and its `first` snapshot, from 0 up to: the speed of a fall through
/// the scene's action (or the fastest in `first`), twice the pressure of all particles' weight spread over the floor,
/// 12 contacts, the highest id.
ColorScale default_scale(const Scene& scene, const ParticleSet& first, ColorBy by);

/// The quantity of every particle, in the set's order. Empty for materials.
std::vector<double> color_values(const Scene& scene, const ParticleSet& particles, double time, const Box3d& action,
                                 ColorBy by);

}  // namespace hooke::render
