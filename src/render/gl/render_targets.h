// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "hooke/render/gl/gl_objects.h"
#include "hooke/render/renderer.h"
#include "hooke/render/water_thickness.h"

namespace hooke::render {

/// The textures that the passes of a picture draw into and read, and the ways to draw into them.
struct RenderTargets {
  explicit RenderTargets(const RenderSettings& settings);

  int width, height;                ///< of the picture, pixels
  bool linear;                      ///< whether the picture keeps what is brighter than white
  int samples_across, samples_down;  ///< size of the textures with several samples a pixel

  // Several samples a pixel.
  gl::Texture color, normal, depth, depth_stencil, shaded;
  // One sample a pixel, except the sun's maps and the water's thickness.
  gl::Texture sun_map, water_sun_map, water_normal, thickness, backdrop, behind, solids, water, result;
  std::array<gl::Texture, 2> surface;
  std::array<gl::Texture, 2> outline;  ///< of water, and of skins
  std::array<gl::Texture, 2> ambient;  ///< for every second pixel along each side

  gl::Framebuffer to_sun_map, to_water_sun_map, to_spheres, to_water_normal, to_ambient, to_blurred, to_backdrop,
      to_shaded, to_behind, to_solids, to_water, to_result;
  std::array<gl::Framebuffer, 2> to_surface, to_outline;

  // Direct later drawing into `target`.
  void begin_samples(const gl::Framebuffer& target) const { begin(target, samples_across, samples_down); }
  void begin_pixels(const gl::Framebuffer& target) const { begin(target, width, height); }
  void begin_ambient(const gl::Framebuffer& target) const { begin(target, half(width), half(height)); }
  void begin_sun_map(const gl::Framebuffer& target) const;

  /// Copies one target of the picture's size into another.
  void copy(const gl::Framebuffer& from, const gl::Framebuffer& to) const;
  /// Puts the water's thickness into its texture.
  void upload_thickness(const WaterThickness& of_water) const;
  /// The brightest light that is kept, in that of white.
  float brightest() const { return linear ? 1000.0f : 1.0f; }
  // The picture in `result`.
  Image read_result() const;
  LinearImage read_linear_result() const;

  static int half(int pixels) { return (pixels + 1) / 2; }

 private:
  static void begin(const gl::Framebuffer& target, int across, int down);
};

}  // namespace hooke::render
