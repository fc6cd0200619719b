// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hooke/base/vec3.h"
#include "hooke/physics/distance_field.h"

namespace hooke {

/// Owns the distance from the surface of a mesh, sampled around it (physics/distance_field.h).
struct DistanceField {
  Vec3d origin{0, 0, 0};               ///< lower corner of the first brick, m
  double cell = 1;                     ///< m
  std::array<std::int32_t, 3> bricks{0, 0, 0};
  std::vector<std::int32_t> directory;
  std::vector<float> samples;
  bool open = false;                   ///< the mesh encloses nothing: distances are never negative
  Vec3d min{0, 0, 0}, max{0, 0, 0};    ///< box around the surface, m
  double band = 0;                     ///< samples reach this far from the surface on either side, m

  DistanceFieldView view() const { return {cell, {bricks[0], bricks[1], bricks[2]}, directory.data(), samples.data()}; }
};

}  // namespace hooke
