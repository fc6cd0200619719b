// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/render/frame.h"
#include "hooke/render/gl/gl_buffers.h"
#include "hooke/render/gl/render_programs.h"
#include "hooke/render/gl/render_targets.h"
#include "hooke/render/visible_spheres.h"

namespace hooke {

/// Computes once a pixel, from surfaces drawn with several samples a pixel: the nearest surface, smoothed where it is
/// water, the water's normals, and how much ambient light arrives. Runs only where there are surfaces: in `box`, and
/// as far around it as the passes read.
class SurfacePasses {
 public:
  SurfacePasses(const RenderTargets& targets, const RenderPrograms& programs, int samples)
      : targets_(targets),
        programs_(programs),
        samples_(samples) {}

  /// `sphere_size` is the radius of a typical sphere, m, > 0.
  void run(const Frame& frame, const Projection& pixels, const PixelRectangle& box, float sphere_size,
           bool water) const;

 private:
  void clear() const;
  void reduce() const;
  void smooth_water(const Projection& pixels, float sphere_size) const;
  void find_water_normals(const Projection& pixels, float sphere_size) const;
  void draw_ambient(const Frame& frame, const Projection& pixels, float sphere_size) const;

  const RenderTargets& targets_;
  const RenderPrograms& programs_;
  int samples_;
  WholePicture whole_;
};

}  // namespace hooke
