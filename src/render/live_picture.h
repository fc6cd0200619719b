// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "hooke/base/vec3.h"
#include "hooke/render/camera.h"
#include "hooke/render/color_map.h"

namespace hooke::render {

/// A particle as the device reads it, 16 bytes.
struct LiveParticle {
  float x, y, z;      ///< relative to the picture's origin, m
  std::uint32_t tag;  ///< live_tag(), or kHiddenParticle
};
static_assert(sizeof(LiveParticle) == 16);

inline constexpr std::uint32_t kHiddenParticle = 0xffffffff;

/// `material` below 65535. `value` in [0, 1]: place in the colour map, or share of white of fast water.
inline std::uint32_t live_tag(std::uint32_t material, float value) {
  const float clamped = value > 0 ? (value < 1 ? value : 1) : 0;  // NaN counts as 0
  return material << 16 | static_cast<std::uint32_t>(clamped * 65535 + 0.5f);
}

/// How particles of a material look.
struct LiveMaterial {
  Color color;
  float radius = 0;      ///< m
  bool whitens = false;  ///< with its particles' values
};

/// An end of a line; two make one.
struct LiveVertex {
  Vec3f position;  ///< relative to the origin, m
  Color color;
  std::uint8_t opacity = 255;
};

/// A half space that is cut away: what lies at dot(normal, x) > offset.
struct ClipPlane {
  Vec3f normal{1, 0, 0};  ///< unit vector
  float offset = 0;       ///< m, relative to the origin
};

/// From where and how a live picture is drawn.
struct LiveView {
  Camera camera;  ///< eye and target relative to the origin
  Vec3d up{0, 1, 0};      ///< against gravity; unit vector
  Vec3d to_sun{0, 1, 0};  ///< unit vector
  Vec3d middle{0, 0, 0};  ///< of the action, relative to the origin
  double size = 1;        ///< of the action, m, > 0
  double ball = 1;        ///< radius of a typical particle, m, > 0
  std::optional<double> ground;  ///< height along `up`, relative to the origin, m
  std::optional<ClipPlane> clip;
  bool particles = true;
  bool spheres = true;    ///< else points
  float point = 2;        ///< their size, pixels
  bool by_value = false;  ///< colours from the map, else of materials
  bool relief = true;     ///< darkens what lies deeper than its surroundings
  bool dark = true;
};

}  // namespace hooke::render
