// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/shaded_mesh.h"

#include <cmath>

namespace hooke::render {

namespace {

constexpr double kSmooth = 0.77;  // cosine of 40 degrees

Vec3d unit(const Vec3d& a) {
  const double length = std::sqrt(dot(a, a));
  return length > 0 ? (1 / length) * a : Vec3d{0, 1, 0};
}

}  // namespace

std::vector<ShadedMesh::Corner> shaded_corners(const TriangleMesh& mesh) {
  const std::size_t n = mesh.triangles.size();
  std::vector<Vec3d> area(n), direction(n);  // normal of twice the triangle's area as length; unit normal
  std::vector<std::vector<std::uint32_t>> around(mesh.vertices.size());
  for (std::size_t t = 0; t < n; ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    area[t] = cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
    direction[t] = unit(area[t]);
    for (const std::uint32_t vertex : mesh.triangles[t]) around[vertex].push_back(static_cast<std::uint32_t>(t));
  }
  std::vector<ShadedMesh::Corner> corners;
  corners.reserve(3 * n);
  for (std::size_t t = 0; t < n; ++t) {
    for (const std::uint32_t vertex : mesh.triangles[t]) {
      Vec3d sum{0, 0, 0};
      for (const std::uint32_t other : around[vertex]) {
        if (dot(direction[other], direction[t]) > kSmooth) sum += area[other];
      }
      corners.push_back({vec_cast<float>(mesh.vertices[vertex]), vec_cast<float>(unit(sum))});
    }
  }
  return corners;
}

}  // namespace hooke::render
