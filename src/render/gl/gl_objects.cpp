// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/gl/gl_objects.h"

#include <stdexcept>
#include <vector>

#include "hooke/base/assert.h"

namespace hooke::render::gl {

namespace {

GLuint compile(GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (!good) {
    char log[2048] = "";
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    throw std::runtime_error(std::string("a shader does not compile: ") + log);
  }
  return shader;
}

}  // namespace

Texture make_texture(int width, int height, GLenum format, GLenum filter) {
  HOOKE_ASSERT(width > 0 && height > 0, width, height);
  HOOKE_ASSERT(filter == GL_NEAREST || filter == GL_LINEAR, filter);
  GLuint name = 0;
  glGenTextures(1, &name);
  Texture texture(name);
  texture.format = format;
  glBindTexture(GL_TEXTURE_2D, name);
  const GLenum layout = format == GL_DEPTH_COMPONENT32F  ? GL_DEPTH_COMPONENT
                        : format == GL_DEPTH32F_STENCIL8 ? GL_DEPTH_STENCIL
                                                         : GL_RGBA;
  const GLenum type = format == GL_DEPTH32F_STENCIL8 ? GL_FLOAT_32_UNSIGNED_INT_24_8_REV : GL_FLOAT;
  glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0, layout, type, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(filter));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, static_cast<GLint>(filter));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

Framebuffer make_framebuffer(std::initializer_list<const Texture*> colors, const Texture* depth) {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  Framebuffer framebuffer(name);
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  std::vector<GLenum> targets;
  for (const Texture* color : colors) {
    targets.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(targets.size()));
    glFramebufferTexture2D(GL_FRAMEBUFFER, targets.back(), GL_TEXTURE_2D, color->get(), 0);
  }
  if (depth != nullptr) {
    glFramebufferTexture2D(GL_FRAMEBUFFER,
                           depth->format == GL_DEPTH32F_STENCIL8 ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                           GL_TEXTURE_2D, depth->get(), 0);
  }
  glDrawBuffers(static_cast<GLsizei>(targets.size()), targets.data());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error("the driver can't draw into textures of this size");
  }
  return framebuffer;
}

Buffer make_buffer() {
  GLuint name = 0;
  glGenBuffers(1, &name);
  return Buffer(name);
}

VertexArray make_vertex_array() {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  return VertexArray(name);
}

Program::Program(const char* vertex, const char* fragment) : program_(glCreateProgram()) {
  link({compile(GL_VERTEX_SHADER, vertex), compile(GL_FRAGMENT_SHADER, fragment)});
}

Program::Program(const char* compute) : program_(glCreateProgram()) { link({compile(GL_COMPUTE_SHADER, compute)}); }

void Program::link(std::initializer_list<GLuint> shaders) {
  for (const GLuint shader : shaders) glAttachShader(program_.get(), shader);
  glLinkProgram(program_.get());
  for (const GLuint shader : shaders) glDeleteShader(shader);
  GLint good = 0;
  glGetProgramiv(program_.get(), GL_LINK_STATUS, &good);
  if (!good) {
    char log[2048] = "";
    glGetProgramInfoLog(program_.get(), sizeof log, nullptr, log);
    throw std::runtime_error(std::string("shaders do not link: ") + log);
  }
  GLint count = 0;
  glGetProgramiv(program_.get(), GL_ACTIVE_UNIFORMS, &count);
  for (GLint k = 0; k < count; ++k) {
    char name[64] = "";
    GLint components = 0;
    GLenum type = GL_NONE;
    glGetActiveUniform(program_.get(), static_cast<GLuint>(k), sizeof name, nullptr, &components, &type, name);
    locations_.emplace(name, glGetUniformLocation(program_.get(), name));
  }
}

void Program::set_rows(const char* name, const Vec3f& x, const Vec3f& y, const Vec3f& z) const {
  const float values[9] = {x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z};
  glUniformMatrix3fv(at(name), 1, GL_TRUE, values);
}

void Program::read(const char* name, int unit, const Texture& texture) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D, texture.get());
  glUniform1i(at(name), unit);
}

}  // namespace hooke::render::gl
