// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/gl/live_culling.h"

#include <cstddef>
#include <string>

#include "hooke/base/assert.h"
#include "hooke/render/gl/shaders.h"
#include "hooke/render/live_picture.h"

namespace hooke::render {

namespace {

constexpr GLuint kGroup = 64;  // of live_footprint.glsl

gl::Program compute_program(const char* text) {
  return gl::Program((std::string(gl::shaders::live_scene_glsl) + gl::shaders::live_footprint_glsl + text).c_str());
}

}  // namespace

LiveCulling::LiveCulling()
    : cover_(compute_program(gl::shaders::live_cover_comp)),
      cull_(compute_program(gl::shaders::live_cull_comp)) {
  glBindVertexArray(array_.get());
  glBindBuffer(GL_ARRAY_BUFFER, seen_.get());
  for (const GLuint location : {0u, 1u}) {
    glEnableVertexAttribArray(location);
    glVertexAttribDivisor(location, 1);
  }
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(LiveParticle), nullptr);
  glVertexAttribIPointer(1, 1, GL_UNSIGNED_INT, sizeof(LiveParticle),
                         reinterpret_cast<const void*>(offsetof(LiveParticle, tag)));
}

void LiveCulling::find_seen(const gl::Buffer& particles, GLsizei count, const gl::Texture& materials, int width,
                            int height) {
  HOOKE_ASSERT(count > 0 && width > 0 && height > 0, count, width, height);
  if (width != width_ || height != height_) {
    GLuint name = 0;
    glGenTextures(1, &name);
    covers_ = gl::Texture(name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_R32UI, width, height);
    // Uninitialised contents are cleared by a framebuffer, which OpenGL 4.3 has, unlike glClearTexImage.
    width_ = width;
    height_ = height;
  }
  const gl::Framebuffer framebuffer = gl::make_framebuffer({&covers_}, nullptr);
  constexpr GLuint kNothing[4] = {0, 0, 0, 0};
  glClearBufferuiv(GL_COLOR, 0, kNothing);

  constexpr GLuint kCommand[4] = {3, 0, 0, 0};
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, command_.get());
  glBufferData(GL_DRAW_INDIRECT_BUFFER, sizeof kCommand, kCommand, GL_STREAM_DRAW);
  if (count > room_ || count < room_ / 4) {
    room_ = count + count / 4;
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, seen_.get());
    glBufferData(GL_SHADER_STORAGE_BUFFER,
                 static_cast<GLsizeiptr>(room_) * static_cast<GLsizeiptr>(sizeof(LiveParticle)), nullptr,
                 GL_STREAM_COPY);
  }
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, particles.get());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, seen_.get());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, command_.get());
  glBindImageTexture(0, covers_.get(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
  const GLuint groups = (static_cast<GLuint>(count) + kGroup - 1) / kGroup;
  for (const gl::Program* program : {&cover_, &cull_}) {
    program->use();
    program->read("materials", 0, materials);
    program->set("count", count);
    glDispatchCompute(groups, 1, 1);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void LiveCulling::draw_seen() const {
  glBindVertexArray(array_.get());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, command_.get());
  glDrawArraysIndirect(GL_TRIANGLES, nullptr);
}

}  // namespace hooke::render
