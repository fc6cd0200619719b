// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/render/frame.h"
#include "hooke/render/gl/render_targets.h"
#include "hooke/render/gl/sun.h"
#include "hooke/render/visible_spheres.h"

namespace hooke::render {

/// The light of one picture.
struct Lighting {
  const Frame* frame = nullptr;
  Sun sun;
  float sphere_size = 1;  ///< radius of a typical ball, m
  bool water = false;     ///< whether there is any

  /// Uses `program` and sets the uniforms of view.glsl and light.glsl; its maps are read through texture units 0 and 9.
  void use(const gl::Program& program, const Projection& view, const RenderTargets& targets) const;
};

}  // namespace hooke::render
