// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "hooke/render/frame.h"
#include "hooke/render/gl/gl_buffers.h"
#include "hooke/render/gl/render_programs.h"
#include "hooke/render/gl/render_targets.h"
#include "hooke/render/visible_spheres.h"

namespace hooke::render {

/// Computes once a pixel, from surfaces drawn with several samples a pixel: the nearest surface, and how much ambient
/// light arrives; of what is to be smoothed, water or skin, the smooth surface and its normals. Runs only where there
/// are surfaces: in `box`, and as far around it as the passes read. `sphere_size` is the radius of a typical sphere, m,
/// > 0.
class SurfacePasses {
 public:
  SurfacePasses(const RenderTargets& targets, const RenderPrograms& programs, int samples)
      : targets_(targets),
        programs_(programs),
        samples_(samples) {}

  /// Which surfaces are smoothed. Those of skins are told apart by their bodies.
  enum class Smooth : std::uint8_t { water, skin };

  /// Finds the outline of surfaces, from spheres that are to be smoothed; they then are to be drawn again, trimmed.
  void find_outline(Smooth what, const Projection& pixels, const PixelRectangle& box, float sphere_size) const;
  /// Finds the smooth surface and its normals, and the ambient light there and on other surfaces.
  void smooth(Smooth what, const Frame& frame, const Projection& pixels, const PixelRectangle& box,
              float sphere_size) const;
  /// Finds the depths of what is not smoothed, and, where asked, its ambient light.
  void find_solids(const Frame& frame, const Projection& pixels, const PixelRectangle& box, float sphere_size,
                   bool ambient) const;

 private:
  void clear_ambient() const;
  /// `drops`: whether drops of water are told apart from the rest.
  void reduce(const gl::Framebuffer& target, bool drops) const;
  void smooth_depths(Smooth what, const Frame& frame, const Projection& pixels, float sphere_size) const;
  void find_normals(Smooth what, const Projection& pixels, float sphere_size) const;
  void draw_ambient(const Frame& frame, const Projection& pixels, const gl::Texture& surface, const PixelRectangle& box,
                    float sphere_size) const;

  const RenderTargets& targets_;
  const RenderPrograms& programs_;
  int samples_;
  WholePicture whole_;
};

}  // namespace hooke::render
