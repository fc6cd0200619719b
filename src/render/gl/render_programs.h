// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/render/gl/gl_objects.h"
#include "hooke/render/visible_spheres.h"

namespace hooke {

/// The shaders of all passes. Made where an OpenGL context is current; throws as gl::Program does.
struct RenderPrograms {
  RenderPrograms();

  gl::Program sun, mesh_sun, sphere, mesh, reduce, smooth, water_normal, ambient, blur, backdrop, ball, water, spark,
      resolve, edge;
};

// Uniforms of the program in use that several have.
void set_view(const gl::Program& program, const Projection& view);
/// What view.glsl asks for.
void set_picture(const gl::Program& program, const Projection& view);

}  // namespace hooke
