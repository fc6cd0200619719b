// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/base/vec3.h"
#include "hooke/core/shapes.h"

namespace hooke {

/// How wind comes and goes: velocity + amplitude sin(2 pi (frequency t - s / wavelength)), where s is the position
/// along the wind.
struct Gust {
  Vec3d amplitude{0, 0, 0};  ///< m/s
  double frequency = 1;      ///< Hz, >= 0
  double wavelength = 0;     ///< m, > 0, of a wind that is not 0; 0: everywhere at once
};

/// A medium that moves.
struct Wind {
  Vec3d velocity{0, 0, 0};  ///< m/s
  /// On each particle, kg/s, >= 0. Without it the materials' own drag is relative to the wind.
  std::optional<double> drag;
  double area_drag = 0;  ///< on the triangles of cloths, kg/(m^2 s), >= 0
  std::optional<Gust> gust;
};

/// The same acceleration everywhere.
struct UniformPush {
  Vec3d acceleration{0, 0, 0};  ///< m/s^2
};

/// A push towards a point: by an acceleration, or, with `time`, like a walker's.
struct PushToward {
  Vec3d point{0, 0, 0};     ///< m
  double acceleration = 0;  ///< m/s^2
  double speed = 0;         ///< desired, m/s, >= 0
  double time = 0;          ///< in which the velocity adapts to `speed`, s, > 0; 0: it does not
};

/// A force on particles that depends on where they are and how they move, not on each other (docs/theory.md eq. 14 to
/// 16): plain data of a scene.
struct Field {
  std::variant<Wind, UniformPush, PushToward> law;
  std::optional<BoxShape> within;      ///< acts on particles whose centre is in this box; else everywhere
  std::vector<std::size_t> materials;  ///< those that feel it, indices into the scene's; none: all
};

struct Scene;
/// What is wrong with the fields of a scene. Paths are those of the scene file.
std::vector<Finding> check_fields(const Scene& scene);

}  // namespace hooke
