// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hooke/base/vec3.h"
#include "hooke/core/triangle_mesh.h"
#include "hooke/render/color_map.h"

namespace hooke::render {

/// A surface of triangles to be drawn.
struct ShadedMesh {
  struct Corner {
    Vec3f position;  ///< relative to Frame::origin, m
    Vec3f normal;    ///< unit vector; turned around where it points away from the viewer
  };
  enum class Sides {
    both,
    inner,  ///< only triangles that face away from the viewer: cut open, to show what is inside
  };

  std::vector<Corner> corners;  ///< three a triangle, counterclockwise as seen from outside
  Color color;
  Sides sides = Sides::both;
  float opacity = 1;      ///< below 1 glass, > 0
  float roughness = 0.5f;  ///< 0 polished to 1 matt

  bool is_glass() const { return opacity < 1; }
  /// The colour, each channel from 0 to 1.
  Vec3f tint() const {
    return (1 / 255.0f) *
           Vec3f{static_cast<float>(color.red), static_cast<float>(color.green), static_cast<float>(color.blue)};
  }
};

/// The corners of a mesh with normals that are smooth where triangles meet at less than 40 degrees.
std::vector<ShadedMesh::Corner> shaded_corners(const TriangleMesh& mesh);

}  // namespace hooke::render
