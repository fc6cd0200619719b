// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/render/gl/gl_objects.h"

namespace hooke::render {

/// Finds out on the device which particles of a live picture can be seen, so that only these are drawn: most are inside
/// of a pile. Needs a current context of OpenGL 4.3, with the block of live_scene.glsl bound. Throws as gl::Program
/// does.
class LiveCulling {
 public:
  LiveCulling();

  /// Looks at `count` (> 0) particles in `particles`, for a picture of this size, pixels. Particles that are left out
  /// can't be seen; those that are kept may still be hidden.
  void find_seen(const gl::Buffer& particles, GLsizei count, const gl::Texture& materials, int width, int height);
  /// Draws a triangle for each particle that was found, an instance each, in the layout of LiveParticle at locations 0
  /// and 1.
  void draw_seen() const;

 private:
  gl::Program cover_, cull_;
  gl::Texture covers_;
  int width_ = 0, height_ = 0;
  GLsizei room_ = 0;  // particles
  gl::Buffer seen_ = gl::make_buffer(), command_ = gl::make_buffer();
  gl::VertexArray array_ = gl::make_vertex_array();
};

}  // namespace hooke::render
