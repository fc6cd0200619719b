// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/random_packing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hooke {
namespace {

void expect_apart(const std::vector<Vec3d>& points, double spacing, const Box3d& box) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_GE(component(points[i], axis), component(box.min, axis));
      ASSERT_LE(component(points[i], axis), component(box.max, axis));
    }
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3d d = points[i] - points[j];
      ASSERT_GE(dot(d, d), spacing * spacing);
    }
  }
}

TEST(RandomPacking, KeepsCentresApart) {
  const Box3d box{{-1, 2, 0}, {4, 7, 5}};
  const auto points = scene::random_packing(box, 0.5, 300, 7);
  EXPECT_EQ(points.size(), 300U);
  expect_apart(points, 0.5, box);
}

TEST(RandomPacking, FillsUpToJamming) {
  // Saturated random sequential addition covers 0.384 of space: 0.733 centres for each cubed spacing. Centres may lie
  // on the box's faces, so there is room for a few more.
  const Box3d box{{0, 0, 0}, {12, 12, 12}};
  const auto points = scene::random_packing(box, 1, scene::kAsManyAsFit, 1);
  expect_apart(points, 1, box);
  EXPECT_GT(static_cast<double>(points.size()), 0.72 * 12 * 12 * 12);
  EXPECT_LT(static_cast<double>(points.size()), 0.733 * 13 * 13 * 13);
}

TEST(RandomPacking, IsTheSameForTheSameSeed) {
  const Box3d box{{0, 0, 0}, {5, 5, 5}};
  EXPECT_EQ(scene::random_packing(box, 1, 50, 3), scene::random_packing(box, 1, 50, 3));
  EXPECT_NE(scene::random_packing(box, 1, 50, 3), scene::random_packing(box, 1, 50, 4));
}

TEST(RandomPacking, EndsWhereNothingMoreFits) {
  EXPECT_EQ(scene::random_packing({{0, 0, 0}, {0.1, 0.1, 0.1}}, 1, 2, 1).size(), 1U);
  EXPECT_EQ(scene::random_packing({{0, 0, 0}, {0, 0, 0}}, 1, scene::kAsManyAsFit, 1).size(), 1U);
  EXPECT_TRUE(scene::random_packing({{0, 0, 0}, {-1, 1, 1}}, 1, 5, 1).empty());
  EXPECT_TRUE(scene::random_packing({{0, 0, 0}, {1, 1, 1}}, 1, 0, 1).empty());
}

TEST(RandomPacking, FillsFlatAndThinBoxes) {
  const Box3d flat{{0, 3, 0}, {20, 3, 20}};
  const auto plane = scene::random_packing(flat, 1, scene::kAsManyAsFit, 1);
  expect_apart(plane, 1, flat);
  EXPECT_GT(static_cast<double>(plane.size()), 0.68 * 400);  // discs jam at 0.547: 0.696 for each squared spacing
  const Box3d line{{0, 0, 0}, {0, 0, 100}};
  const auto row = scene::random_packing(line, 1, scene::kAsManyAsFit, 1);
  expect_apart(row, 1, line);
  EXPECT_GT(static_cast<double>(row.size()), 72.0);  // Renyi's car parking: 0.7476
}

TEST(RandomPacking, NeedsLittleForAFewInAVastBox) {
  const Box3d box{{0, 0, 0}, {1e9, 1e9, 1e9}};
  EXPECT_EQ(scene::random_packing(box, 1, 100, 1).size(), 100U);
}

}  // namespace
}  // namespace hooke
