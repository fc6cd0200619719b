// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hooke {
namespace {

std::vector<Vec3d> sites(const scene::Lattice& lattice, std::uint64_t count = ~std::uint64_t{0}) {
  std::vector<Vec3d> all;
  lattice.append_sites(count, all);
  return all;
}

double smallest_distance(const std::vector<Vec3d>& points) {
  double smallest = INFINITY;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3d d = points[i] - points[j];
      smallest = std::min(smallest, std::sqrt(dot(d, d)));
    }
  }
  return smallest;
}

TEST(UpDirection, IsAgainstGravity) {
  EXPECT_EQ(scene::up_against({0, -9.8, 0}).axis, 1);
  EXPECT_TRUE(scene::up_against({0, -9.8, 0}).positive);
  EXPECT_EQ(scene::up_against({2, -1, -9.8}).axis, 2);
  EXPECT_EQ(scene::up_against({9.8, 0, 0}).axis, 0);
  EXPECT_FALSE(scene::up_against({9.8, 0, 0}).positive);
  EXPECT_EQ(scene::up_against({0, 0, 0}).axis, 1);
  EXPECT_TRUE(scene::up_against({0, 0, 0}).positive);
}

TEST(Lattice, CubicFillsTheBoxWithBothFaces) {
  const scene::Lattice lattice(scene::LatticeKind::cubic, {{0, 0, 0}, {1, 2, 3}}, 1, {});
  EXPECT_EQ(lattice.site_count(), 2U * 3U * 4U);
  const auto all = sites(lattice);
  ASSERT_EQ(all.size(), 24U);
  EXPECT_EQ(all.front(), (Vec3d{0, 0, 0}));
  EXPECT_EQ(all.back(), (Vec3d{1, 2, 3}));
  EXPECT_DOUBLE_EQ(smallest_distance(all), 1);
}

TEST(Lattice, CountsDespiteRounding) {
  // 9.999999 spacings hold eleven sites; the last one is drawn back to the face.
  const Box3d box{{0, 0, 0}, {9.999999, 0, 0}};
  const scene::Lattice lattice(scene::LatticeKind::cubic, box, 1, {});
  EXPECT_EQ(lattice.site_count(), 11U);
  for (const Vec3d& x : sites(lattice)) EXPECT_LE(x.x, box.max.x);
  EXPECT_EQ(scene::Lattice(scene::LatticeKind::cubic, {{0, 0, 0}, {0.7, 0, 0}}, 0.1, {}).site_count(), 8U);
  EXPECT_EQ(scene::Lattice(scene::LatticeKind::cubic, {{0, 0, 0}, {9.99, 0, 0}}, 1, {}).site_count(), 10U);
}

TEST(Lattice, HcpIsClosePacked) {
  const scene::Lattice lattice(scene::LatticeKind::hcp, {{0, 0, 0}, {5, 5, 5}}, 1, {});
  const auto all = sites(lattice);
  EXPECT_EQ(all.size(), lattice.site_count());
  EXPECT_NEAR(smallest_distance(all), 1, 1e-12);
  // In the middle every site has twelve neighbours.
  const Vec3d middle{2.5, 2.5, 2.5};
  const auto nearer = [&](const Vec3d& a, const Vec3d& b) {
    return dot(a - middle, a - middle) < dot(b - middle, b - middle);
  };
  const Vec3d centre = *std::min_element(all.begin(), all.end(), nearer);
  const auto touching = std::count_if(all.begin(), all.end(), [&](const Vec3d& x) {
    const Vec3d d = x - centre;
    return dot(d, d) > 0.5 && dot(d, d) < 1.01;
  });
  EXPECT_EQ(touching, 12);
  for (const Vec3d& x : all) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(component(x, axis), 0);
      EXPECT_LE(component(x, axis), 5);
    }
  }
}

TEST(Lattice, ComesInWholeLayersLowestFirst) {
  for (const scene::UpDirection up :
       {scene::UpDirection{1, true}, scene::UpDirection{2, true}, scene::UpDirection{0, false}}) {
    for (const scene::LatticeKind kind : {scene::LatticeKind::cubic, scene::LatticeKind::hcp}) {
      const auto all = sites(scene::Lattice(kind, {{0, 0, 0}, {4, 4, 4}}, 1, up));
      double last = -INFINITY;
      for (const Vec3d& x : all) {
        const double height = up.positive ? component(x, up.axis) : -component(x, up.axis);
        EXPECT_GE(height, last);
        last = height;
      }
      EXPECT_EQ(component(all.front(), up.axis), up.positive ? 0 : 4);
    }
  }
}

TEST(Lattice, StopsAtTheCount) {
  const scene::Lattice lattice(scene::LatticeKind::cubic, {{0, 0, 0}, {9, 9, 9}}, 1, {});
  const auto some = sites(lattice, 250);
  ASSERT_EQ(some.size(), 250U);
  EXPECT_EQ(some[99].y, 0);
  EXPECT_EQ(some[100].y, 1);
  EXPECT_EQ(some[249].y, 2);
}

TEST(Lattice, CountsMoreThanThereCouldBe) {
  const scene::Lattice lattice(scene::LatticeKind::cubic, {{0, 0, 0}, {1e12, 1e12, 1e12}}, 1e-3, {});
  EXPECT_GE(lattice.site_count(), std::uint64_t{1} << 62U);
  EXPECT_EQ(scene::Lattice(scene::LatticeKind::hcp, {{0, 0, 0}, {1, -1, 1}}, 1, {}).site_count(), 0U);
}

}  // namespace
}  // namespace hooke
