// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hooke/render/frame.h"

namespace hooke::render {

/// Maps points of space to pixels of a picture, counted from its lower left corner.
struct Projection {
  Vec3f eye, right, up, back;  ///< position of the camera, m, and its unit axes
  float width = 0, height = 0;  ///< of the picture, pixels
  float scale = 1;              ///< pixels a metre: at any depth where parallel, else at a depth of 1 m
  bool parallel = false;        ///< parallel rays, as of the sun, instead of a camera's
  float nearest = 0.01f;        ///< nothing nearer than this depth is seen, m, > 0 unless parallel
};

/// The projection of a camera onto a picture of this size, > 0.
Projection project(const Camera& camera, int width, int height);

/// Indices, ascending, of the spheres that may show in at least one pixel: spheres in the picture that are not wholly
/// behind others. Conservative: a sphere left out can't be seen; a sphere kept may still be hidden. The naive way draws
/// every sphere, and most spheres are inside a pile. Same result for any number of threads.
std::vector<std::uint32_t> visible_spheres(std::span<const Sphere> spheres, const Projection& projection);

/// A rectangle of a picture, pixels.
struct PixelRectangle {
  int x = 0, y = 0;  ///< of its lower left corner
  int width = 0, height = 0;
};

/// The smallest rectangle of the picture that holds all of these spheres; empty where there are none.
PixelRectangle bounds_on_picture(std::span<const Sphere> spheres, std::span<const std::uint32_t> chosen,
                                 const Projection& projection);

}  // namespace hooke::render
