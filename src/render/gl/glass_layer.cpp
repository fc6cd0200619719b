// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/gl/glass_layer.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace hooke::render {

namespace {

// Square of the distance from `eye` to the mesh's nearest corner, m^2.
float nearest_square(const ShadedMesh& mesh, const Vec3f& eye) {
  float least = std::numeric_limits<float>::max();
  for (const ShadedMesh::Corner& corner : mesh.corners) {
    const Vec3f to = corner.position - eye;
    least = std::min(least, dot(to, to));
  }
  return least;
}

}  // namespace

void GlassLayer::draw(const RenderTargets& targets, const gl::Program& program, const MeshBuffer& buffer,
                      std::span<const ShadedMesh> meshes, const Vec3f& eye) {
  if (framebuffer_.get() == 0) {
    texture_ = gl::make_texture(targets.samples_across, targets.samples_down, GL_RGBA16F, GL_NEAREST);
    framebuffer_ = gl::make_framebuffer({&texture_}, &targets.depth_stencil);
  }
  std::vector<std::pair<float, std::size_t>> order;
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    if (meshes[k].is_glass()) order.emplace_back(-nearest_square(meshes[k], eye), k);
  }
  std::sort(order.begin(), order.end());
  targets.begin_samples(framebuffer_);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_FALSE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  for (const auto& [square, k] : order) {
    program.set("tint", meshes[k].tint());
    program.set("opacity", meshes[k].opacity);
    program.set("roughness", meshes[k].roughness);
    buffer.draw(k, MeshBuffer::Faces::away);
    buffer.draw(k, MeshBuffer::Faces::towards);
  }
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace hooke::render
