// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>

#include "hooke/base/expected.h"
#include "hooke/render/image.h"
#include "hooke/render/live_picture.h"
#include "hooke/render/shaded_mesh.h"

namespace hooke::render {

/// Draws a running simulation into the window whose OpenGL context is current: everything that depends on the number of
/// particles is done by the device, from one upload of 16 bytes a particle.
class LiveRenderer {
 public:
  /// The version that it needs.
  static constexpr int kMajor = 4, kMinor = 3;

  /// bad_input where the current context is older, or its driver takes no shader of ours.
  static Expected<LiveRenderer> create();
  ~LiveRenderer();
  LiveRenderer(LiveRenderer&&) noexcept;
  LiveRenderer& operator=(LiveRenderer&&) noexcept;

  /// By their index in particles' tags; at least one.
  void set_materials(std::span<const LiveMaterial> materials);
  void set_particles(std::span<const LiveParticle> particles);
  void set_meshes(std::span<const ShadedMesh> meshes);
  /// An even number of ends.
  void set_lines(std::span<const LiveVertex> ends);

  /// Draws into the window's framebuffer, of this size in pixels, > 0. Throws std::runtime_error where the driver can't
  /// draw pictures of this size.
  void draw(const LiveView& view, int width, int height);
  /// What the window's framebuffer shows.
  static Image read_window(int width, int height);
  /// The device that draws, in its driver's words.
  static std::string device();

 private:
  struct Impl;
  explicit LiveRenderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace hooke::render
