// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/render/frame.h"
#include "hooke/render/gl/gl_objects.h"
#include "hooke/render/visible_spheres.h"

namespace hooke::render {

/// The domain's edges that belong to a wall, on the device, each an instance of one triangle strip.
class TankEdges {
 public:
  TankEdges();
  void upload(const Tank& tank);
  /// Draws them into what is drawn into, where nothing of `depths`, several samples a pixel, is before them.
  void draw(const gl::Program& program, const Projection& view, const Vec3f& color, const gl::Texture& depths,
            int samples) const;

 private:
  gl::VertexArray array_;
  gl::Buffer buffer_;
  GLsizei count_ = 0;
};

}  // namespace hooke::render
