// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/gl/tank_edges.h"

#include <vector>

#include "hooke/render/gl/render_programs.h"

namespace hooke::render {

TankEdges::TankEdges() : array_(gl::make_vertex_array()), buffer_(gl::make_buffer()) {
  glBindVertexArray(array_.get());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.get());
  for (GLuint end = 0; end < 2; ++end) {
    glEnableVertexAttribArray(end);
    glVertexAttribPointer(end, 3, GL_FLOAT, GL_FALSE, 2 * sizeof(Vec3f),
                          reinterpret_cast<const void*>(end * sizeof(Vec3f)));  // NOLINT(performance-no-int-to-ptr)
    glVertexAttribDivisor(end, 1);
  }
}

void TankEdges::upload(const Tank& tank) {
  std::vector<Vec3f> ends;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (!tank.walls[static_cast<std::size_t>(u)] && !tank.walls[static_cast<std::size_t>(v)]) continue;
    for (int corner = 0; corner < 4; ++corner) {
      Vec3d from = tank.min;
      component(from, u) = component(corner & 1 ? tank.max : tank.min, u);
      component(from, v) = component(corner & 2 ? tank.max : tank.min, v);
      Vec3d to = from;
      component(to, axis) = component(tank.max, axis);
      ends.push_back(vec_cast<float>(from));
      ends.push_back(vec_cast<float>(to));
    }
  }
  count_ = static_cast<GLsizei>(ends.size() / 2);
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(ends.size() * sizeof(Vec3f)), ends.data(), GL_STREAM_DRAW);
}

void TankEdges::draw(const gl::Program& program, const Projection& view, const Vec3f& color, const gl::Texture& depths,
                     int samples) const {
  program.use();
  set_view(program, view);
  program.set("scale", 2 * view.scale / view.width, 2 * view.scale / view.height);
  program.set("picture", view.width, view.height);
  program.set("width", 1.4f);
  program.set("nearest", view.nearest);
  program.read("depths", 0, depths);
  program.set("samples", samples);
  program.set("color", color);
  program.set("opacity", 0.55f);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glBindVertexArray(array_.get());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count_);
  glDisable(GL_BLEND);
}

}  // namespace hooke::render
