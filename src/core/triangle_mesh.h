// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hooke/base/vec3.h"

namespace hooke {

/// Triangles that share vertices.
struct TriangleMesh {
  std::vector<Vec3d> vertices;                          ///< m
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of vertices, anticlockwise as seen from outside
};

}  // namespace hooke
