// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <epoxy/gl.h>

#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "hooke/base/vec3.h"
#include "hooke/render/camera.h"

namespace hooke::render::gl {

/// The name of an OpenGL object, deleted with its owner, in the context that is current then.
template <auto& Delete>
class Object {
 public:
  Object() = default;
  explicit Object(GLuint name) : name_(name) {}
  ~Object() {
    if (name_ != 0) Delete(name_);
  }
  Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  GLuint get() const { return name_; }

 private:
  GLuint name_ = 0;
};

inline void delete_buffer(GLuint name) { glDeleteBuffers(1, &name); }
inline void delete_vertex_array(GLuint name) { glDeleteVertexArrays(1, &name); }
inline void delete_texture(GLuint name) { glDeleteTextures(1, &name); }
inline void delete_framebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }
inline void delete_program(GLuint name) { glDeleteProgram(name); }

using Buffer = Object<delete_buffer>;
using VertexArray = Object<delete_vertex_array>;
using Framebuffer = Object<delete_framebuffer>;

/// A two-dimensional texture.
struct Texture : Object<delete_texture> {
  using Object::Object;
  GLenum format = GL_NONE;
};

/// A texture of a size > 0, with undefined contents; `filter` is GL_NEAREST or GL_LINEAR.
Texture make_texture(int width, int height, GLenum format, GLenum filter);
/// Draws into `colors`, in this order, and `depth` (null: none), with its stencil where it has one.
Framebuffer make_framebuffer(std::initializer_list<const Texture*> colors, const Texture* depth);
Buffer make_buffer();
VertexArray make_vertex_array();

/// A vertex and a fragment shader, and their uniforms by name; setting a uniform that the shaders don't use does
/// nothing. A shader that does not compile throws std::runtime_error with the driver's words.
class Program {
 public:
  Program() = default;
  Program(const char* vertex, const char* fragment);
  /// A compute shader (OpenGL 4.3), likewise.
  explicit Program(const char* compute);

  void use() const { glUseProgram(program_.get()); }
  // Set a uniform of the program in use.
  void set(const char* name, int value) const { glUniform1i(at(name), value); }
  void set(const char* name, int x, int y) const { glUniform2i(at(name), x, y); }
  void set(const char* name, float value) const { glUniform1f(at(name), value); }
  void set(const char* name, float x, float y) const { glUniform2f(at(name), x, y); }
  void set(const char* name, const Vec3f& v) const { glUniform3f(at(name), v.x, v.y, v.z); }
  /// Sets a 3 x 3 matrix with rows x, y, z.
  void set_rows(const char* name, const Vec3f& x, const Vec3f& y, const Vec3f& z) const;
  /// Lets the sampler `name` read `texture` through texture unit `unit`.
  void read(const char* name, int unit, const Texture& texture) const;

 private:
  GLint at(std::string_view name) const {
    const auto found = locations_.find(name);
    return found == locations_.end() ? -1 : found->second;
  }

  void link(std::initializer_list<GLuint> shaders);

  Object<delete_program> program_;
  std::map<std::string, GLint, std::less<>> locations_;  // of the uniforms in use
};

}  // namespace hooke::render::gl
