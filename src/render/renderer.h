// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "hooke/render/frame.h"
#include "hooke/render/image.h"
#include "hooke/render/linear_image.h"

namespace hooke::render {

struct RenderSettings {
  int width = 1280;  ///< pixels, at least 1 and no more than OpenGL can draw
  int height = 720;
  /// Along each side of a pixel: a pixel is the mean of samples squared; 1 to 4.
  int samples = 2;
  bool linear = false;  ///< whether it draws pictures in linear light, and no others
};

/// Figures of the last frame drawn.
struct RenderFigures {
  std::size_t spheres_drawn = 0;  ///< without those that culling left out because they can't be seen
  double cull_seconds = 0;
  double total_seconds = 0;
};

/// Draws frames into images. Belongs to the thread that made it.
class Renderer {
 public:
  virtual ~Renderer() = default;
  /// bad_input where the device can't draw a picture of this size.
  virtual Expected<Image> render(const Frame& frame) = 0;
  /// The same picture in linear light, not cut off at white. Either this or render(), as RenderSettings::linear says.
  virtual Expected<LinearImage> render_linear(const Frame& frame) = 0;
  virtual RenderFigures figures() const = 0;
  /// The device that draws, in its driver's words.
  virtual std::string device() const = 0;
};

}  // namespace hooke::render
