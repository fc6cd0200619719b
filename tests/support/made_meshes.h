// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "hooke/core/shapes.h"
#include "hooke/core/triangle_mesh.h"

namespace hooke::test {

// Meshes of simple shapes, for tests.

using Profile = std::vector<std::array<double, 2>>;  // distance from the y axis and height, from top to bottom, m

inline constexpr double kPi = std::numbers::pi;

// The profile turned around the y axis in `pieces` steps; closed where the profile starts and ends on the axis.
inline TriangleMesh turned(const Profile& profile, int pieces) {
  TriangleMesh mesh;
  std::vector<std::vector<std::uint32_t>> rings;
  for (const auto& [radius, height] : profile) {
    rings.emplace_back();
    for (int p = 0; p < pieces; ++p) {
      const double angle = 2 * kPi * p / pieces;
      if (p == 0 || radius > 1e-9)
        mesh.vertices.push_back({radius * std::cos(angle), height, radius * std::sin(angle)});
      rings.back().push_back(static_cast<std::uint32_t>(mesh.vertices.size() - 1));
    }
    rings.back().push_back(rings.back().front());
  }
  const auto add_triangle = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    if (i != j && j != k && k != i) mesh.triangles.push_back({i, j, k});
  };
  for (std::size_t ring = 0; ring + 1 < rings.size(); ++ring) {
    const auto &upper = rings[ring], &lower = rings[ring + 1];
    for (std::size_t p = 0; p + 1 < upper.size(); ++p) {
      add_triangle(upper[p], upper[p + 1], lower[p + 1]);
      add_triangle(upper[p], lower[p + 1], lower[p]);
    }
  }
  return mesh;
}

// A quarter or a half of a circle, from one angle above the horizon to another.
inline void add_arc(Profile& profile, double center, double radius, double from, double to, int pieces) {
  for (int i = 0; i <= pieces; ++i) {
    const double angle = from + (to - from) * i / pieces;
    profile.push_back({radius * std::cos(angle), center + radius * std::sin(angle)});
  }
}

inline TriangleMesh ball_mesh(double center, double radius, int pieces) {
  Profile profile;
  add_arc(profile, center, radius, kPi / 2, -kPi / 2, pieces / 2);
  return turned(profile, pieces);
}

inline TriangleMesh capsule_mesh(double top, double bottom, double radius, int pieces) {
  Profile profile;
  add_arc(profile, top, radius, kPi / 2, 0, pieces / 4);
  add_arc(profile, bottom, radius, 0, -kPi / 2, pieces / 4);
  return turned(profile, pieces);
}

inline TriangleMesh box_mesh(const Vec3d& min, const Vec3d& max) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back({i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z});
  }
  for (const auto& [a, b, c, d] : std::initializer_list<std::array<std::uint32_t, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return mesh;
}

inline std::string obj_text(const TriangleMesh& mesh) {
  std::ostringstream text;
  text.precision(9);
  text << "mtllib ../secret.mtl\n";
  for (const Vec3d& x : mesh.vertices) text << "v " << x.x << ' ' << x.y << ' ' << x.z << '\n';
  for (const auto& t : mesh.triangles) text << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  return text.str();
}

inline double distance(const Shape& shape, const Vec3d& x) {
  return shape_distance(geometry_of(shape, false, {0, 0, 0}), x).distance;
}

}  // namespace hooke::test
