// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// What distance fields take of memory, and where they are known.
#include "hooke/volumes/mesh_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hooke/physics/enclosure.h"
#include "support/made_meshes.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

constexpr double kMost = 2.5e8;

TriangleMesh two_boxes(double edge, double apart) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {edge, edge, edge});
  const Vec3d at{apart, apart, apart};
  const TriangleMesh other = box_mesh(at, at + Vec3d{edge, edge, edge});
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  return mesh;
}

volumes::FieldOptions options_of(double cell, double reach, bool closed, double depth = 3) {
  volumes::FieldOptions options;
  options.cell = cell;
  options.reach = reach;
  options.closed = closed;
  options.depth = depth;
  return options;
}

// Two small boxes 1000 edges apart take twice what one takes.
TEST(MeshField, TakesMemoryWithTheSurface) {
  const volumes::FieldOptions options = options_of(0.1, 0.3, true);
  const auto one = volumes::make_distance_field(box_mesh({0, 0, 0}, {1, 1, 1}), options);
  const auto two = volumes::make_distance_field(two_boxes(1, 1000), options);
  ASSERT_TRUE(one && two);
  EXPECT_LT(two->bytes(), 3 * one->bytes());
  const DistanceFieldView field = two->view();
  EXPECT_TRUE(encloses(field, Vec3d{0.5, 0.5, 0.5} - two->origin));
  EXPECT_TRUE(encloses(field, Vec3d{1000.5, 1000.5, 1000.5} - two->origin));
  EXPECT_FALSE(encloses(field, Vec3d{500, 500, 500} - two->origin));
}

// Also where a point is deeper than any sample.
TEST(MeshField, KnowsItsInsideHoweverDeep) {
  for (const double depth : {1.0, 3.0}) {
    const auto made =
        volumes::make_distance_field(box_mesh({-1, -1, -1}, {1, 2, 1}), options_of(0.01, 0.03, true, depth));
    ASSERT_TRUE(made);
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const auto r = random4(3, i);
      const Vec3d x{3 * r[0] - 1.5, 4 * r[1] - 1.5, 3 * r[2] - 1.5};
      const double off = std::max({std::abs(x.x) - 1, std::abs(x.y - 0.5) - 1.5, std::abs(x.z) - 1});
      if (std::abs(off) < 0.01) continue;
      EXPECT_EQ(encloses(made->view(), x - made->origin), off < 0) << x.x << ' ' << x.y;
    }
  }
}

// All that lies within the reach outside, and within so many times the reach inside, has a distance and a normal.
TEST(MeshField, IsKnownWhereverItIsNeeded) {
  const auto made = volumes::make_distance_field(box_mesh({-1, -1, -1}, {1, 1, 1}), options_of(0.05, 0.13, true));
  ASSERT_TRUE(made);
  for (double x = 1 - 3 * 0.13; x <= 1.13; x += 0.003) {
    const auto found = field_distance(made->view(), Vec3d{x, 0.123, 0.321} - made->origin);
    EXPECT_NEAR(found.distance, x - 1, 1e-6);
    EXPECT_NEAR(found.normal.x, 1, 1e-6);
  }
}

TEST(MeshField, ExpectsAboutAsManySamplesAsItHas) {
  const std::pair<TriangleMesh, volumes::FieldOptions> cases[] = {
      {box_mesh({0, 0, 0}, {1, 1, 1}), options_of(0.02, 0.06, true)},
      {ball_mesh(0, 1, 64), options_of(0.02, 0.07, true)},
      {ball_mesh(0, 1, 512), options_of(0.05, 0.15, true, 1)},
      {two_boxes(1, 300), options_of(0.05, 0.15, true)}};
  for (const auto& [mesh, options] : cases) {
    const auto made = volumes::make_distance_field(mesh, options);
    ASSERT_TRUE(made);
    const double ratio = volumes::expected_samples(mesh, options, kMost) / static_cast<double>(made->samples.size());
    EXPECT_GT(ratio, 1 / 1.5);
    EXPECT_LT(ratio, 1.5);
  }
}

// A triangle without area is as large as it is long.
TEST(MeshField, CountsSlivers) {
  TriangleMesh sliver;
  sliver.vertices = {{0, 0, 0}, {300, 0, 0}, {150, 0, 0}};
  sliver.triangles = {{0, 1, 2}};
  EXPECT_GT(volumes::expected_samples(sliver, options_of(1e-3 / 3, 1e-3, false), kMost), kMost);
  EXPECT_TRUE(volumes::spans_few_cells(sliver, options_of(1e-3 / 3, 1e-3, false)));
  sliver.vertices[1].x = 1e6;
  EXPECT_FALSE(volumes::spans_few_cells(sliver, options_of(0.03, 0.1, false)));
  EXPECT_FALSE(volumes::make_distance_field(sliver, options_of(0.03, 0.1, false)));
  sliver.vertices[1].x = HUGE_VAL;
  EXPECT_FALSE(volumes::spans_few_cells(sliver, options_of(0.03, 0.1, false)));
}

}  // namespace
}  // namespace hooke::test
