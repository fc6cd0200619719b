// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/collider_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hooke {
namespace {

Domain domain() {
  Domain d;
  d.min = {-3, -3, -3};
  d.max = {3, 3, 3};
  return d;
}

// Corners lie on the shape, and triangles are counterclockwise as seen from outside.
TEST(ShapeSurface, LiesOnTheShapeAndFacesOutward) {
  const Shape shapes[] = {PlaneShape{{0.2, 0.1, 0}, {1, 2, 3}},
                          BoxShape{{-1, -0.5, -2}, {1, 0.7, 0}},
                          SphereShape{{0.2, 0.1, -0.3}, 0.8},
                          CapsuleShape{{-0.5, 0, 0}, {0.6, 0.3, -0.4}, 0.45},
                          CylinderShape{{-0.5, 0.1, 0}, {0.6, 1, -0.4}, 0.6},
                          DiscShape{{0.1, 0.2, 0}, {1, 2, -1}, 0.9}};
  for (const Shape& shape : shapes) {
    const ShapeGeometry<double> g = geometry_of(shape, false, {0, 0, 0});
    const TriangleMesh mesh = render::shape_surface(shape, domain());
    ASSERT_GT(mesh.triangles.size(), 0U) << shape.index();
    for (const Vec3d& x : mesh.vertices) EXPECT_NEAR(shape_distance(g, x).distance, 0, 1e-12) << shape.index();
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3d &x = mesh.vertices[a], &y = mesh.vertices[b], &z = mesh.vertices[c];
      const Vec3d normal = cross(y - x, z - x), middle = (1.0 / 3) * (x + y + z);
      const double twice = std::sqrt(dot(normal, normal));
      area += 0.5 * twice;
      if (twice < 1e-9) continue;  // at a pole
      const Vec3d outside = middle + (1e-3 / twice) * normal;
      EXPECT_GT(shape_distance(g, outside).distance, shape_distance(g, middle).distance) << shape.index();
    }
    // A round surface of 96 pieces a turn lacks a thousandth of its area.
    if (shape.index() == 2) {
      EXPECT_NEAR(area / (4 * M_PI * 0.64), 1, 2e-3);
    }
    if (shape.index() == 5) {
      EXPECT_NEAR(area / (M_PI * 0.81), 1, 2e-3);
    }
  }
}

TEST(ColliderMeshes, MoveWithTheirColliders) {
  Scene scene;
  scene.domain = domain();
  scene.colliders.resize(1);
  scene.colliders[0].shape = BoxShape{{0, 0, 0}, {2, 1, 1}};
  scene.colliders[0].motion = SteadyMotion{{1, 0, 0}, {0, 0, M_PI / 2}, Vec3d{0, 0, 0}};
  const std::vector<render::ShadedMesh> meshes = render::collider_meshes(scene, 1, {10, 0, 0});
  ASSERT_EQ(meshes.size(), 1U);
  // After a quarter of a turn about 0 the box spans x = -1 to 0 and goes up to y = 2; it is moved by 1, and positions
  // are relative to (10, 0, 0).
  float low = 1e9f, high = -1e9f, top = -1e9f;
  for (const render::ShadedMesh::Corner& corner : meshes[0].corners) {
    low = std::min(low, corner.position.x);
    high = std::max(high, corner.position.x);
    top = std::max(top, corner.position.y);
    EXPECT_NEAR(dot(corner.normal, corner.normal), 1, 1e-5);
  }
  EXPECT_NEAR(low, -10, 1e-5);
  EXPECT_NEAR(high, -9, 1e-5);
  EXPECT_NEAR(top, 2, 1e-5);
  EXPECT_EQ(meshes[0].sides, render::ShadedMesh::Sides::both);
  scene.colliders[0].hollow = true;
  EXPECT_EQ(render::collider_meshes(scene, 1, {0, 0, 0})[0].sides, render::ShadedMesh::Sides::inner);
}

}  // namespace
}  // namespace hooke
