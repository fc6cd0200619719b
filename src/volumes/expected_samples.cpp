// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <cmath>

#include "hooke/volumes/mesh_field.h"

namespace hooke {

double expected_samples(const TriangleMesh& mesh, const FieldOptions& options) {
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3d n = cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    area += 0.5 * std::sqrt(dot(n, n));
  }
  // Bricks that the band only touches add about half a brick on either side.
  constexpr int kCells = DistanceFieldView::kCells;
  const double band = (options.closed ? 4 : 2) * options.reach + (4 + kCells) * options.cell;
  return area * band / (options.cell * options.cell * options.cell);
}

}  // namespace hooke
