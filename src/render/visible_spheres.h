// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hooke/render/frame.h"

namespace hooke {

/// How a point of space falls onto a picture, in pixels, from its lower left corner.
struct Projection {
  Vec3f eye, right, up, back;  ///< the camera's place, m, and its unit axes
  float width = 0, height = 0;  ///< of the picture, pixels
  float scale = 1;              ///< pixels a metre: everywhere where parallel, else at a depth of 1 m
  bool parallel = false;        ///< the light of the sun, in place of a camera
  float nearest = 0.01f;        ///< depth below which nothing is seen, m, > 0 unless parallel
};

/// The projection of a camera onto a picture of this size, > 0.
Projection project(const Camera& camera, int width, int height);

/// Indices, ascending, of the spheres of which any pixel may be seen: those in the picture that are not wholly behind
/// others. Conservative: what it leaves out can't be seen; some of what it keeps can't either. The naive way draws
/// every sphere, most of them inside of a pile. Same result for any number of threads.
std::vector<std::uint32_t> visible_spheres(std::span<const Sphere> spheres, const Projection& projection);

/// A rectangle of a picture, pixels.
struct PixelRectangle {
  int x = 0, y = 0;  ///< of its lower left corner
  int width = 0, height = 0;
};

/// The smallest rectangle of the picture that holds all of these spheres; empty where there are none.
PixelRectangle bounds_on_picture(std::span<const Sphere> spheres, std::span<const std::uint32_t> chosen,
                                 const Projection& projection);

}  // namespace hooke
