// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/neighbours/cell_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <set>

#include "hooke/base/random.h"

namespace hooke {
namespace {

struct Box {
  const char* name;
  Vec3d min, max;
  bool periodic[3];
  double reach;
};

void PrintTo(const Box& box, std::ostream* os) { *os << box.name; }

const Box kBoxes[] = {
    {"open", {0, 0, 0}, {10, 8, 6}, {false, false, false}, 1},
    {"negative", {-1005, -8, -60}, {-995, -1, -54}, {false, false, false}, 1.3},
    {"periodic", {0, 0, 0}, {10, 8, 6}, {true, true, true}, 1},
    {"periodic_one_cell", {0, 0, 0}, {1.9, 1, 1.5}, {true, true, true}, 1},
    {"periodic_two_cells", {0, 0, 0}, {2, 2.9, 2.5}, {true, true, true}, 1},
    {"periodic_three_cells", {-1, 0, 5}, {2, 3.9, 8.5}, {true, true, true}, 1},
    {"periodic_shorter_than_reach", {0, 0, 0}, {0.6, 5, 5}, {true, false, false}, 1},
    {"mixed_axes", {0, 0, 0}, {2, 3, 7}, {true, false, true}, 1},
    {"flat", {0, 0, 0}, {30, 0.1, 30}, {false, false, false}, 1},
    {"a_point", {3, 3, 3}, {3, 3, 3}, {false, false, false}, 1},
    {"a_million_cells", {0, 0, 0}, {1e9, 1e9, 5}, {false, true, false}, 1},
};

class Grids : public testing::TestWithParam<Box> {
 protected:
  Grids() { grid_.lay_out(box().min, box().max, box().periodic, box().reach); }

  static const Box& box() { return GetParam(); }
  static Vec3d point(std::uint64_t i) {
    const auto u = uniform4(1, i, 0);
    const Vec3d size = box().max - box().min;
    return box().min + Vec3d{u[0] * size.x, u[1] * size.y, u[2] * size.z};
  }

  // Whether the cells around `key` include `other`; each cell may be named only once.
  bool is_around(std::uint64_t key, std::uint64_t other) const {
    CellGrid::KeyRange ranges[CellGrid::kMostRanges];
    const std::size_t count = grid_.neighbour_ranges(key, ranges);
    EXPECT_LE(count, 18U);
    int found = 0;
    for (std::size_t r = 0; r < count; ++r) {
      EXPECT_LE(ranges[r].first, ranges[r].last);
      if (other >= ranges[r].first && other <= ranges[r].last) ++found;
    }
    EXPECT_LE(found, 1) << "a cell in two ranges would list its points twice";
    return found == 1;
  }

  CellGrid grid_;
};

TEST_P(Grids, FindTheCellsAroundSeveralOfARowOnceEach) {
  for (std::uint64_t i = 0; i < 300; ++i) {
    const std::uint64_t key = grid_.key_of(point(i));
    Vec3d end = point(i);
    end.x = box().max.x;
    const std::uint64_t last = grid_.key_of(end);
    ASSERT_GE(last, key);
    for (int more = 0; more <= 4 && key + static_cast<std::uint64_t>(more) <= last; ++more) {
      std::multiset<std::uint64_t> several;
      std::set<std::uint64_t> one_by_one;
      CellGrid::KeyRange ranges[CellGrid::kMostRanges];
      for (std::size_t r = grid_.neighbour_ranges(key, ranges, more); r-- > 0;) {
        for (std::uint64_t k = ranges[r].first; k <= ranges[r].last; ++k) several.insert(k);
      }
      for (int d = 0; d <= more; ++d) {
        for (std::size_t r = grid_.neighbour_ranges(key + static_cast<std::uint64_t>(d), ranges); r-- > 0;) {
          for (std::uint64_t k = ranges[r].first; k <= ranges[r].last; ++k) one_by_one.insert(k);
        }
      }
      ASSERT_TRUE(std::equal(several.begin(), several.end(), one_by_one.begin(), one_by_one.end())) << more;
    }
  }
}

TEST_P(Grids, HaveCellsNoSmallerThanTheReach) {
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GE(grid_.axis(axis).cell, box().reach);
    EXPECT_GE(grid_.axis(axis).count, 1);
    EXPECT_LE(grid_.axis(axis).count, CellGrid::kMaxCells);
  }
}

TEST_P(Grids, FindEverythingWithinReachInTheCellsAround) {
  const Vec3d size = box().max - box().min;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Vec3d a = point(i);
    // A step of up to the reach in any direction; a point that leaves a periodic axis comes back on the other side.
    const auto u = uniform4(2, i, 0);
    Vec3d b = a;
    for (int axis = 0; axis < 3; ++axis) {
      double& x = component(b, axis);
      x += (2 * u[static_cast<std::size_t>(axis)] - 1) * box().reach / std::sqrt(3.0);
      const double min = component(box().min, axis), max = component(box().max, axis);
      if (box().periodic[axis]) {
        x -= std::floor((x - min) / (max - min)) * component(size, axis);
      } else {
        x = std::min(std::max(x, min), max);
      }
    }
    ASSERT_TRUE(is_around(grid_.key_of(a), grid_.key_of(b))) << i;
    ASSERT_TRUE(is_around(grid_.key_of(b), grid_.key_of(a))) << i;
    ASSERT_TRUE(is_around(grid_.key_of(a), grid_.key_of(a))) << i;
  }
}

TEST_P(Grids, KeysEndBeforeTheirEnd) {
  for (const Vec3d& x : {box().min, box().max, box().min - Vec3d{1, 1, 1}, box().max + Vec3d{1, 1, 1},
                         Vec3d{1e300, -1e300, 0}, Vec3d{-1e300, 1e300, 1e300}}) {
    EXPECT_LT(grid_.key_of(x), grid_.key_end());
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, Grids, testing::ValuesIn(kBoxes),
                         [](const auto& instance) { return instance.param.name; });

TEST(CellGrid, GeometryAnswersAsTheGridDoes) {
  CellGrid grid;
  grid.lay_out({-1, 0, 2}, {5, 3, 4}, {true, false, true}, 0.3);
  const GridGeometry geometry = grid.geometry();
  EXPECT_EQ(geometry.key_end(), grid.key_end());
  for (int i = 0; i < 200; ++i) {
    const Vec3d x{-1.5 + 0.035 * i, 0.016 * i, 2 + 0.01 * i};
    EXPECT_EQ(geometry.key_of(x), grid.key_of(x));
    EXPECT_EQ(geometry.path_key_of(x), grid.path_key_of(x));
  }
}

TEST(CellGrid, CellsOfARowAreConsecutive) {
  CellGrid grid;
  grid.lay_out({0, 0, 0}, {10, 10, 10}, {false, false, false}, 1);
  EXPECT_EQ(grid.key_of({1.5, 2.5, 3.5}) + 1, grid.key_of({2.5, 2.5, 3.5}));
  CellGrid::KeyRange ranges[CellGrid::kMostRanges];
  EXPECT_EQ(grid.neighbour_ranges(grid.key_of({5, 5, 5}), ranges), 9U) << "one range a row";
}

TEST(CellGrid, NearlyRoundNumbersOfCellsKeepTheirSize) {
  for (const double reach : {0.1, 0.3, 1.0 / 3, 0.7}) {
    for (int n = 1; n < 60; ++n) {
      CellGrid grid;
      grid.lay_out({0, 0, 0}, {n * reach, n * reach, n * reach}, {true, false, true}, reach);
      EXPECT_GE(grid.axis(0).cell, reach);
      EXPECT_GE(grid.axis(0).count, n - 1);
    }
  }
}

}  // namespace
}  // namespace hooke
