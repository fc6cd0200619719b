// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/render/frame.h"
#include "hooke/render/gl/gl_objects.h"

namespace hooke::render {

/// Spheres on the device, one instance of a triangle each.
class SphereBuffer {
 public:
  SphereBuffer() : array_(gl::make_vertex_array()), buffer_(gl::make_buffer()) {
    glBindVertexArray(array_.get());
    glBindBuffer(GL_ARRAY_BUFFER, buffer_.get());
    attribute(0, 3, GL_FLOAT, offsetof(Sphere, x));
    attribute(1, 1, GL_FLOAT, offsetof(Sphere, radius));
    attribute(2, 4, GL_UNSIGNED_BYTE, offsetof(Sphere, color));
    attribute(3, 1, GL_UNSIGNED_BYTE, offsetof(Sphere, roughness));
    attribute(4, 1, GL_UNSIGNED_BYTE, offsetof(Sphere, body));
  }

  bool empty() const { return spheres_.empty(); }
  void clear() { spheres_.clear(); }
  void add(const Sphere& sphere) { spheres_.push_back(sphere); }
  void upload() const {
    glBindBuffer(GL_ARRAY_BUFFER, buffer_.get());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(spheres_.size() * sizeof(Sphere)), spheres_.data(),
                 GL_STREAM_DRAW);
  }
  void draw() const {
    glBindVertexArray(array_.get());
    glDrawArraysInstanced(GL_TRIANGLES, 0, 3, static_cast<GLsizei>(spheres_.size()));
  }

 private:
  static void attribute(GLuint location, GLint components, GLenum type, std::size_t offset) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, components, type, type == GL_UNSIGNED_BYTE, sizeof(Sphere),
                          reinterpret_cast<const void*>(offset));
    glVertexAttribDivisor(location, 1);
  }

  gl::VertexArray array_;
  gl::Buffer buffer_;
  std::vector<Sphere> spheres_;
};
static_assert(offsetof(Sphere, foam) == offsetof(Sphere, color) + 3);

/// One triangle that covers the picture (whole_picture.vert).
class WholePicture {
 public:
  void draw() const {
    glBindVertexArray(array_.get());
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }

 private:
  gl::VertexArray array_ = gl::make_vertex_array();
};

/// Surfaces on the device, all of a frame in one buffer.
class MeshBuffer {
 public:
  MeshBuffer() : array_(gl::make_vertex_array()), buffer_(gl::make_buffer()) {
    glBindVertexArray(array_.get());
    glBindBuffer(GL_ARRAY_BUFFER, buffer_.get());
    for (GLuint k = 0; k < 2; ++k) {
      glEnableVertexAttribArray(k);
      glVertexAttribPointer(k, 3, GL_FLOAT, GL_FALSE, sizeof(ShadedMesh::Corner),
                            reinterpret_cast<const void*>(k * sizeof(Vec3f)));
    }
  }

  void upload(std::span<const ShadedMesh> meshes) {
    std::vector<ShadedMesh::Corner> corners;
    first_.clear();
    for (const ShadedMesh& mesh : meshes) {
      first_.push_back(static_cast<GLint>(corners.size()));
      corners.insert(corners.end(), mesh.corners.begin(), mesh.corners.end());
    }
    first_.push_back(static_cast<GLint>(corners.size()));
    glBindBuffer(GL_ARRAY_BUFFER, buffer_.get());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(ShadedMesh::Corner)), corners.data(),
                 GL_STREAM_DRAW);
  }

  /// Which triangles are drawn: all, or those that face away from the eye or towards it.
  enum class Faces { all, away, towards };

  /// Draws the k-th mesh uploaded.
  void draw(std::size_t k, Faces faces) const {
    glBindVertexArray(array_.get());
    if (faces != Faces::all) {
      glEnable(GL_CULL_FACE);
      glCullFace(faces == Faces::away ? GL_FRONT : GL_BACK);
    }
    HOOKE_ASSERT(k + 1 < first_.size(), k, first_.size());
    glDrawArrays(GL_TRIANGLES, first_[k], first_[k + 1] - first_[k]);
    glDisable(GL_CULL_FACE);
  }

 private:
  gl::VertexArray array_;
  gl::Buffer buffer_;
  std::vector<GLint> first_;
};
static_assert(sizeof(ShadedMesh::Corner) == 2 * sizeof(Vec3f));

}  // namespace hooke::render
