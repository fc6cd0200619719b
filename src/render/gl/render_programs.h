// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/render/gl/gl_objects.h"
#include "hooke/render/visible_spheres.h"

namespace hooke::render {

/// The shaders of all passes. The constructor needs a current OpenGL context; throws as gl::Program does.
struct RenderPrograms {
  RenderPrograms();

  gl::Program sun, mesh_sun, sphere, mesh, reduce, outline, smooth, water_normal, ambient, blur, backdrop, ball, skin,
      water, spark, glass, resolve, edge;
};

// Set uniforms of the program in use that several programs have in common.
void set_view(const gl::Program& program, const Projection& view);
/// The uniforms of view.glsl.
void set_picture(const gl::Program& program, const Projection& view);

}  // namespace hooke::render
