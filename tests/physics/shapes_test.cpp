// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Distances from shapes against a search for the nearest of many points of their surfaces, and at points where many
// places of a surface are nearest.

#include "hooke/core/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/particles.h"

namespace hooke::test {
namespace {

const Shape kShapes[] = {BoxShape{{-1, -0.5, -2}, {1, 0.7, 0}}, SphereShape{{0.2, 0.1, -0.3}, 0.8},
                         CapsuleShape{{-0.5, 0, 0}, {0.6, 0.3, -0.4}, 0.45},
                         CylinderShape{{-0.5, 0.1, 0}, {0.6, 0.4, -0.4}, 0.6},
                         DiscShape{{0.1, 0.2, 0}, {1, 2, -1}, 0.9}};

Vec3d at_random(std::uint64_t i, double reach) {
  const auto r = random4(5, i);
  return {reach * (2 * r[0] - 1), reach * (2 * r[1] - 1), reach * (2 * r[2] - 1)};
}

double length_of(const Vec3d& a) { return std::sqrt(dot(a, a)); }

// The normal leads to the surface: a step of the distance against the normal ends on it, and no point of the surface
// is closer.
TEST(ShapeDistance, LeadsToTheSurfaceAndNothingIsNearer) {
  for (const Shape& shape : kShapes) {
    const ShapeGeometry<double> g = geometry_of(shape, false, {0, 0, 0});
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const Vec3d x = at_random(i, 2);
      const SurfaceDistance<double> d = shape_distance(g, x);
      EXPECT_NEAR(length_of(d.normal), 1, 1e-14);
      const Vec3d foot = x - d.distance * d.normal;
      EXPECT_NEAR(shape_distance(g, foot).distance, 0, 1e-14) << shape.index();
      // A distance changes by no more than the point moves; along the normal it grows by exactly that.
      const Vec3d beside = x + 0.1 * at_random(i + 7777, 1);
      EXPECT_LE(std::abs(shape_distance(g, beside).distance - d.distance), length_of(beside - x) + 1e-14);
      if (d.distance > 0) {
        EXPECT_NEAR(shape_distance(g, x + 0.01 * d.normal).distance, d.distance + 0.01, 1e-13) << shape.index();
      }
    }
  }
}

TEST(ShapeDistance, IsNegativeInside) {
  const auto at = [](const Shape& s, const Vec3d& x) { return shape_distance(geometry_of(s, false, {0, 0, 0}), x); };
  EXPECT_NEAR(at(kShapes[0], {0, 0.1, -1}).distance, -0.6, 1e-15);
  EXPECT_NEAR(at(kShapes[1], {0.2, 0.1, 0.2}).distance, -0.3, 1e-15);
  EXPECT_NEAR(at(CapsuleShape{{0, 0, 0}, {0, 2, 0}, 1}, {0.5, 2, 0}).distance, -0.5, 1e-15);
  EXPECT_NEAR(at(CylinderShape{{0, 0, 0}, {0, 2, 0}, 1}, {0.5, 1.8, 0}).distance, -0.2, 1e-15);
  EXPECT_NEAR(at(PlaneShape{{0, 1, 0}, {0, 2, 0}}, {9, 0.5, 9}).distance, -0.5, 1e-15);
  EXPECT_EQ(at(PlaneShape{{0, 1, 0}, {0, 2, 0}}, {9, 0.5, 9}).normal, (Vec3d{0, 1, 0}));
}

TEST(ShapeDistance, IsFiniteWhereManyPlacesAreNearest) {
  const std::pair<Shape, Vec3d> places[] = {
      {SphereShape{{1, 2, 3}, 2}, {1, 2, 3}},
      {CapsuleShape{{0, 0, 0}, {0, 2, 0}, 1}, {0, 1, 0}},
      {CapsuleShape{{0, 0, 0}, {0, 2, 0}, 1}, {0, 0, 0}},
      {CylinderShape{{0, 0, 0}, {0, 8, 0}, 1}, {0, 4, 0}},
      {CylinderShape{{0, 0, 0}, {0, 2, 0}, 1}, {0, 5, 0}},
      {DiscShape{{0, 0, 0}, {0, 1, 0}, 1}, {0, 0, 0}},
      {DiscShape{{0, 0, 0}, {0, 1, 0}, 1}, {1, 0, 0}},
      {BoxShape{{-1, -1, -1}, {1, 1, 1}}, {0, 0, 0}},
      {BoxShape{{-1, -1, -1}, {1, 1, 1}}, {1, 1, 1}},
      {PlaneShape{{0, 0, 0}, {0, 1, 0}}, {0, 0, 0}},
  };
  for (const auto& [shape, x] : places) {
    for (const bool hollow : {false, true}) {
      for_each_face(geometry_of(shape, hollow, {0, 0, 0}), x, [&, index = shape.index()](const auto& face) {
        EXPECT_TRUE(std::isfinite(face.distance)) << index;
        EXPECT_NEAR(length_of(face.normal), 1, 1e-14) << index << " hollow " << hollow;
      });
    }
  }
}

// From inside a hollow cylinder its mantle and both ends are three faces, from outside it is one face.
TEST(HollowShapes, AreTouchedFromBothSides) {
  const auto faces_within = [](const Shape& s, const Vec3d& x, double radius) {
    std::vector<Vec3d> normals;
    for_each_face(geometry_of(s, true, {0, 0, 0}), x, [&](const SurfaceDistance<double>& face) {
      const Vec3d& n = face.normal;  // along an axis, up to rounding
      if (face.distance < radius) normals.push_back({std::round(n.x), std::round(n.y), std::round(n.z)});
    });
    return normals;
  };
  using Normals = std::vector<Vec3d>;
  const Shape drum = CylinderShape{{0, 0, 0}, {0, 0, 4}, 2};
  EXPECT_EQ(faces_within(drum, {0, -1.9, 0.1}, 0.25), (Normals{{0, 1, 0}, {0, 0, 1}})) << "in the corner";
  EXPECT_EQ(faces_within(drum, {0, -1.9, 2}, 0.25), (Normals{{0, 1, 0}}));
  EXPECT_EQ(faces_within(drum, {0, -2.1, 2}, 0.25), (Normals{{0, -1, 0}})) << "from outside";
  EXPECT_EQ(faces_within(drum, {0, 0, 3.9}, 0.25), (Normals{{0, 0, -1}}));
  const Shape crate = BoxShape{{0, 0, 0}, {4, 4, 4}};
  EXPECT_EQ(faces_within(crate, {0.1, 0.1, 3.9}, 0.25), (Normals{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}));
  EXPECT_EQ(faces_within(crate, {2, 4.1, 2}, 0.25), (Normals{{0, 1, 0}}));
  const Shape bowl = SphereShape{{0, 0, 0}, 2};
  EXPECT_EQ(faces_within(bowl, {0, -1.9, 0}, 0.25), (Normals{{0, 1, 0}}));
  EXPECT_EQ(faces_within(bowl, {0, -2.1, 0}, 0.25), (Normals{{0, -1, 0}}));
  const Shape sheet = PlaneShape{{0, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(faces_within(sheet, {0, -0.1, 0}, 0.25), (Normals{{0, -1, 0}}));
}

}  // namespace
}  // namespace hooke::test
