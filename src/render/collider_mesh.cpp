// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/collider_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hooke/base/parallel.h"
#include "hooke/physics/shapes.h"

namespace hooke::render {

namespace {

constexpr int kPieces = 96;  // in a whole turn
constexpr const char* kSteel = "#a9b2bb";

using Polygon = std::vector<Vec3d>;

void add_polygon(TriangleMesh& mesh, const Polygon& polygon) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), polygon.begin(), polygon.end());
  for (std::uint32_t k = 2; k < polygon.size(); ++k) mesh.triangles.push_back({first, first + k - 1, first + k});
}

TriangleMesh box_surface(const Vec3d& min, const Vec3d& max) {
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool upper : {false, true}) {
      Polygon face(4, upper ? max : min);
      for (std::size_t k = 0; k < 4; ++k) {
        const bool far_u = k == 1 || k == 2, far_v = k >= 2;
        component(face[k], upper ? u : v) = component(far_u ? max : min, upper ? u : v);
        component(face[k], upper ? v : u) = component(far_v ? max : min, upper ? v : u);
      }
      add_polygon(mesh, face);
    }
  }
  return mesh;
}

// The surface that `line` sweeps when it turns around the shape's axis. Points of `line`: distance from the axis and
// height above the middle, from the top down.
TriangleMesh turned_surface(const ShapeGeometry<double>& g, const std::vector<std::array<double, 2>>& line) {
  const Vec3d third = cross(g.axis, g.across);
  TriangleMesh mesh;
  for (const auto& [away, height] : line) {
    for (int p = 0; p < kPieces; ++p) {
      const double angle = 2 * std::numbers::pi * p / kPieces;
      mesh.vertices.push_back(g.center + height * g.axis +
                              away * (std::cos(angle) * g.across + std::sin(angle) * third));
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < line.size(); ++ring) {
    for (std::uint32_t p = 0; p < kPieces; ++p) {
      const std::uint32_t a = ring * kPieces + p, b = ring * kPieces + (p + 1) % kPieces;
      mesh.triangles.push_back({a, a + kPieces, b + kPieces});
      mesh.triangles.push_back({a, b + kPieces, b});
    }
  }
  return mesh;
}

// A sphere or capsule: a straight side from `half_length` above the middle to as much below, and round ends.
TriangleMesh round_surface(ShapeGeometry<double> g) {
  if (g.kind == ShapeKind::sphere) {
    g.axis = {0, 1, 0};
    g.across = {1, 0, 0};
  }
  std::vector<std::array<double, 2>> line;
  for (const double end : {1.0, -1.0}) {
    constexpr int kQuarter = kPieces / 4;
    for (int i = 0; i <= kQuarter; ++i) {
      const double angle =
          std::numbers::pi / 2 * (end - static_cast<double>(i) / kQuarter) + (end < 0 ? std::numbers::pi / 2 : 0);
      line.push_back({g.radius * std::cos(angle), end * g.half_length + g.radius * std::sin(angle)});
    }
  }
  return turned_surface(g, line);
}

// `polygon` without what lies behind the plane through `point`.
Polygon clipped(const Polygon& polygon, const Vec3d& point, const Vec3d& normal) {
  Polygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double from = dot(a - point, normal), to = dot(b - point, normal);
    if (from >= 0) kept.push_back(a);
    if ((from >= 0) != (to >= 0)) kept.push_back(a + (from / (from - to)) * (b - a));
  }
  return kept;
}

TriangleMesh plane_surface(const ShapeGeometry<double>& g, const Domain& domain) {
  const Vec3d size = domain.max - domain.min, middle = 0.5 * (domain.min + domain.max);
  const double reach = std::sqrt(dot(size, size));
  const Vec3d third = cross(g.axis, g.across);
  const Vec3d foot = middle - dot(middle - g.center, g.axis) * g.axis;
  Polygon polygon;
  for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    polygon.push_back(foot + (u * reach) * g.across + (v * reach) * third);
  }
  for (int axis = 0; axis < 3; ++axis) {
    Vec3d inward{0, 0, 0};
    component(inward, axis) = 1;
    polygon = clipped(clipped(polygon, domain.min, inward), domain.max, -inward);
  }
  TriangleMesh mesh;
  add_polygon(mesh, polygon);
  return mesh;
}

bool encloses_space(const Shape& shape) {
  if (const auto* mesh = std::get_if<MeshShape>(&shape)) return !mesh->field->open;
  return !std::holds_alternative<PlaneShape>(shape) && !std::holds_alternative<DiscShape>(shape);
}

}  // namespace

TriangleMesh shape_surface(const Shape& shape, const Domain& domain) {
  const ShapeGeometry<double> g = geometry_of(shape, false, {0, 0, 0});
  switch (g.kind) {
    case ShapeKind::plane:
      return plane_surface(g, domain);
    case ShapeKind::box:
      return box_surface(g.center - g.half, g.center + g.half);
    case ShapeKind::sphere:
    case ShapeKind::capsule:
      return round_surface(g);
    case ShapeKind::cylinder:
      return turned_surface(
          g, {{0, g.half_length}, {g.radius, g.half_length}, {g.radius, -g.half_length}, {0, -g.half_length}});
    case ShapeKind::disc:
      return turned_surface(g, {{0, 0}, {g.radius, 0}});
    case ShapeKind::mesh:
      break;
  }
  return *std::get<MeshShape>(shape).surface;
}

std::vector<ShadedMesh> collider_meshes(const Scene& scene, double time, const Vec3d& origin) {
  std::vector<ShadedMesh> meshes;
  for (const Collider& collider : scene.colliders) {
    ShadedMesh mesh;
    const Material material = collider.material ? scene.materials[*collider.material] : Material{};
    if (material.opacity <= 0) continue;
    mesh.opacity = static_cast<float>(material.opacity);
    mesh.roughness = static_cast<float>(material.roughness);
    const std::string& color = material.color;
    mesh.color = parse_color(color.empty() ? kSteel : color.c_str());
    const bool open_mesh = std::holds_alternative<MeshShape>(collider.shape) && !encloses_space(collider.shape);
    const bool cut = collider.hollow && (encloses_space(collider.shape) || open_mesh);
    mesh.sides = cut && !mesh.is_glass() ? ShadedMesh::Sides::inner : ShadedMesh::Sides::both;
    mesh.corners = shaded_corners(shape_surface(collider.shape, scene.domain));
    const ColliderPose pose = pose_at(collider, time);
    const Vec3d pivot = pivot_of(collider);
    parallel_ranges(mesh.corners.size(), 4096, [&](std::size_t first, std::size_t last) {
      const auto turned = [&pose](const Vec3d& a) {
        return a.x * pose.turn[0] + a.y * pose.turn[1] + a.z * pose.turn[2];
      };
      for (std::size_t k = first; k < last; ++k) {
        ShadedMesh::Corner& corner = mesh.corners[k];
        const Vec3d at = vec_cast<double>(corner.position);
        corner.position = vec_cast<float>(pose.pivot + turned(at - pivot) - origin);
        corner.normal = vec_cast<float>(turned(vec_cast<double>(corner.normal)));
      }
    });
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

}  // namespace hooke::render
