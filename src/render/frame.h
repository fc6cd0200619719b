// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/render/camera.h"
#include "hooke/render/color_map.h"
#include "hooke/render/coloring.h"
#include "hooke/render/shaded_mesh.h"

namespace hooke::render {

/// A sphere to be drawn.
struct Sphere {
  float x, y, z;        ///< centre, relative to Frame::origin, m
  float radius;         ///< m
  Color color;
  std::uint8_t foam;    ///< 0: an opaque ball; else water, 1 clear to 255 white
  bool glows = false;   ///< whether the ball shines by itself and throws no shadow
  bool skin = false;    ///< whether an opaque ball is part of a smooth skin
  std::uint8_t roughness = 128;  ///< 0 polished to 255 matt; of water, from 0 in a pool to 255 of a drop of its own
  std::uint8_t body = 0;  ///< of a skin: spheres of different bodies do not melt into one surface
};

/// What a sphere is part of; each kind is drawn in its own way.
enum class SphereKind : std::uint8_t { ball, skin, spark, water };
inline SphereKind kind_of(const Sphere& sphere) {
  return sphere.foam > 0 ? SphereKind::water
         : sphere.glows  ? SphereKind::spark
         : sphere.skin   ? SphereKind::skin
                         : SphereKind::ball;
}

/// The tank: the domain, and which of its faces are walls.
struct Tank {
  Vec3d min, max;               ///< relative to Frame::origin, m
  std::array<bool, 3> walls{};  ///< whether the two faces across each axis push back
};

/// All that a picture shows: no solver, no file, no device.
struct Frame {
  Vec3d origin{0, 0, 0};  ///< all positions are relative to it, so that single precision suffices in any domain, m
  std::vector<Sphere> spheres;
  std::size_t fine_drops = 0;  ///< how many of them, at the end, are parts of the spray that the others are
  std::vector<ShadedMesh> meshes;
  Tank tank;
  Camera camera;  ///< eye and target relative to the origin
  Box3d action;     ///< relative to the origin
  Vec3d up{0, 1, 0};
  Vec3d across{1, 0, 0};  ///< level unit vectors; `across` is along the longer side of the action
  Vec3d along{0, 0, 1};
  Vec3d to_sun{0, 1, 0};  ///< unit vector
  std::optional<double> ground;     ///< height of the ground along `up`, relative to the origin, m
  bool ground_lines = true;
  std::optional<Color> ground_color;  ///< dark without
  std::optional<Color> background;    ///< one colour behind everything; without, a sky
  bool bright_sky = false;            ///< whether that sky is bright; else it is dark
  bool transparent = false;           ///< nothing behind everything: pictures have alpha
  float sunlight = 1, skylight = 1;   ///< brightness of the sun, and of the light from all around
  bool night = false;  ///< a black sky, as among stars: where particles attract each other and there is no ground
  float daylight = 1;               ///< brightness of sun and sky, less at night
  std::optional<ColorScale> scale;  ///< of the legend; empty: no legend
};

/// The radius of the sphere that draws a particle of a material, m. Of water it is changed by what is around.
float drawn_radius(const Material& material);

/// The median radius of some spheres of a kind, m; 1 m where there is none.
float typical_radius(const Frame& frame, SphereKind kind);

/// What stays the same for all pictures of a run.
struct Look {
  Box3d action;             ///< where the scene's action takes place (action.h)
  ColorScale scale;
  double foam_speed = 1;  ///< speed of a fall from the top, which water that foams is measured by, m/s, > 0
};

/// The look of a run, from its scene and its `first` snapshot. `range`, two ascending values, replaces the ends of the
/// default scale.
Look make_look(const Scene& scene, const ParticleSet& first, ColorBy by,
               const std::optional<std::array<double, 2>>& range = {});

/// The picture of `particles` at `time` (s). `aspect`: width over height, > 0.
Frame make_frame(const Scene& scene, const ParticleSet& particles, double time, const Look& look, double aspect);

}  // namespace hooke::render
