// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/render/frame.h"
#include "hooke/render/gl/gl_objects.h"
#include "hooke/render/visible_spheres.h"

namespace hooke::render {

inline constexpr int kSunMap = 1280;  ///< pixels along each side of the shadow map

/// A parallel projection along the sun's rays that holds the whole action, and room around it for splashes.
struct Sun {
  Projection projection;
  float range = 1;  ///< m, from the projection's eye to the farthest lit point
  Vec3f to;         ///< unit vector

  /// Sets the uniforms of light.glsl that say where the sun is and how its map is read.
  void set(const gl::Program& program) const;
  /// From metres to coordinates of the map in [-1, 1].
  float scale() const { return 2 * projection.scale / kSunMap; }
};

Sun make_sun(const Frame& frame);

/// The diagonal of the action, m.
float action_size(const Frame& frame);

}  // namespace hooke::render
