// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "hooke/render/gl/gl_buffers.h"
#include "hooke/render/gl/render_targets.h"

namespace hooke::render {

/// The glass of a picture, several samples a pixel: to be laid over what is behind it. Made when it is first needed.
class GlassLayer {
 public:
  /// Draws what glass is not hidden by what `targets` have the depths of, with `program`, whose light and view are set:
  /// of each mesh first the far side, then the near one, meshes from the farthest to the nearest to `eye`.
  void draw(const RenderTargets& targets, const gl::Program& program, const MeshBuffer& buffer,
            std::span<const ShadedMesh> meshes, const Vec3f& eye);
  /// After draw().
  const gl::Texture& texture() const { return texture_; }

 private:
  gl::Texture texture_;
  gl::Framebuffer framebuffer_;
};

}  // namespace hooke::render
