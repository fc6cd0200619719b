// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/neighbours/cell_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "hooke/base/random.h"

namespace hooke {
namespace {

struct Setting {
  const char* name;
  std::size_t count;
  Vec3d min, max;
  bool periodic[3];
  double spread;  // part of the box that points lie in
  std::vector<CellList::Level> levels;
};

void PrintTo(const Setting& setting, std::ostream* os) { *os << setting.name; }

const Setting kSettings[] = {
    {"nothing", 0, {0, 0, 0}, {5, 5, 5}, {false, false, false}, 1, {{0.5, 1}}},
    {"one", 1, {0, 0, 0}, {5, 5, 5}, {false, false, false}, 1, {{0.5, 1}}},
    {"dense", 5000, {0, 0, 0}, {12, 14, 16}, {false, false, false}, 1, {{0.5, 1}}},
    {"more_than_a_block", 40'000, {-9, 0, 0}, {12, 14, 90}, {false, false, false}, 1, {{0.5, 1}}},
    {"three_levels", 5000, {0, 0, 0}, {12, 14, 16}, {false, false, false}, 1, {{0.5, 1}, {1, 2}, {8, 16}}},
    {"periodic", 5000, {-1, 0, 3}, {12, 14, 16}, {true, true, true}, 1, {{0.5, 1.1}, {3, 6}}},
    {"sparse", 3000, {-5e5, -5e5, -5e5}, {5e5, 5e5, 5e5}, {false, false, false}, 1, {{0.5, 1}}},
    {"a_cluster_in_a_large_box", 3000, {0, 0, 0}, {5e5, 5e5, 5e5}, {true, false, true}, 2e-5, {{0.5, 1}, {1, 2}}},
    {"a_spot", 300, {0, 0, 0}, {1e3, 1e3, 1e3}, {false, false, false}, 0, {{0.5, 1}}},
};

class CellLists : public testing::TestWithParam<Setting> {
 protected:
  CellLists() {
    cells_.lay_out(setting().min, setting().max, setting().periodic, setting().levels, setting().count);
    for (std::uint64_t i = 0; i < setting().count; ++i) points_.push_back(point(i, setting().spread));
  }

  static const Setting& setting() { return GetParam(); }
  static Vec3d point(std::uint64_t i, double spread) {
    const auto u = uniform4(41, i, 0);
    const Vec3d size = setting().max - setting().min;
    return setting().min + spread * Vec3d{u[0] * size.x, u[1] * size.y, u[2] * size.z};
  }
  static std::size_t level_of(std::size_t i) { return i * i % setting().levels.size(); }
  static bool is_gone(std::size_t i) { return i % 17 == 3; }
  std::uint64_t key_of(std::size_t i) const {
    return is_gone(i) ? cells_.key_end() : cells_.key_of(points_[i], level_of(i));
  }
  void sort(std::span<std::byte> scratch = {}) {
    cells_.sort(points_.size(), [&](std::size_t i) { return key_of(i); }, order_, scratch);
  }

  CellList cells_;
  std::vector<Vec3d> points_;
  std::vector<std::uint32_t> order_{1, 2, 3};  // earlier contents must not matter
};

TEST_P(CellLists, SortPointsByLevelAndCell) {
  std::vector<std::uint32_t> expected;
  for (std::uint32_t i = 0; i < points_.size(); ++i) expected.push_back(i);
  std::sort(expected.begin(), expected.end(),
            [&](auto a, auto b) { return key_of(a) != key_of(b) ? key_of(a) < key_of(b) : a < b; });
  std::vector<std::uint64_t> scratch(3 * points_.size(), 77);
  for (const std::size_t part : {0U, 1U}) {
    sort(std::as_writable_bytes(std::span(scratch)).subspan(0, part * 24 * points_.size()));
    ASSERT_EQ(order_, expected);
  }

  std::size_t end = 0;
  for (std::size_t level = 0; level < cells_.level_count(); ++level) {
    for (std::size_t i = 0; i < points_.size(); ++i) end += !is_gone(i) && level_of(i) == level ? 1 : 0;
    ASSERT_EQ(cells_.level_end(level), end);
  }
  ASSERT_EQ(cells_.point_count(), end);
}

// Every point in the box is found, no point is found twice, and no point far from the box is found.
TEST_P(CellLists, FindEverythingInABoxOnce) {
  sort();
  const Vec3d size = setting().max - setting().min;
  std::size_t inside = 0;
  for (std::uint64_t q = 0; q < 200; ++q) {
    const std::size_t level = q % cells_.level_count();
    const double cell = setting().levels[level].cell;
    const auto u = uniform4(42, q, 0);
    const Vec3d middle = point(q, setting().spread);
    const Vec3d half = 2 * cell * Vec3d{u[0], u[1], u[2]};
    std::vector<SearchRange> ranges;
    const std::size_t points = cells_.find(level, middle - half, middle + half, ranges);

    std::vector<int> found(points_.size(), 0);
    std::size_t total = 0;
    for (const SearchRange& range : ranges) {
      ASSERT_LT(range.from, range.to);
      total += range.to - range.from;
      for (std::uint32_t k = range.from; k < range.to; ++k) ++found[order_[k]];
    }
    ASSERT_EQ(total, points);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      ASSERT_LE(found[i], 1);
      if (is_gone(i) || level_of(i) != level) {
        ASSERT_EQ(found[i], 0);
        continue;
      }
      double outside = -INFINITY;  // the furthest along an axis, in cells
      for (int axis = 0; axis < 3; ++axis) {
        double d = component(points_[i], axis) - component(middle, axis);
        if (setting().periodic[axis]) d -= component(size, axis) * std::nearbyint(d / component(size, axis));
        outside = std::max(outside, (std::abs(d) - component(half, axis)) / cells_.grid(level).axis(axis).cell);
      }
      if (outside < 0) {
        ASSERT_EQ(found[i], 1) << i;
        ++inside;
      } else if (outside > 1.001) {
        ASSERT_EQ(found[i], 0) << i;
      }
    }
  }
  if (setting().count > 1000 && setting().name != std::string("sparse")) {
    EXPECT_GT(inside, 1000U);
  }
}

// With far more ranges than the list looks up at a time, too.
TEST_P(CellLists, VisitWhoeverIsNearOnce) {
  sort();
  const Vec3d size = setting().max - setting().min;
  for (std::uint64_t q = 0; q < 50; ++q) {
    const Vec3d at = point(q, setting().spread);
    const double reach = static_cast<double>(q % 10) * setting().levels[0].cell;
    std::vector<int> found(points_.size(), 0);
    cells_.for_points_near(at, reach, [&](std::size_t k) { ++found[order_[k]]; });
    for (std::size_t i = 0; i < points_.size(); ++i) {
      ASSERT_LE(found[i], is_gone(i) ? 0 : 1) << i;
      const std::size_t level = level_of(i);
      const double radius = setting().levels[level].largest_radius;
      double distance2 = 0, outside = -INFINITY;  // of the box around, the furthest along an axis, in cells
      for (int axis = 0; axis < 3; ++axis) {
        double d = component(points_[i], axis) - component(at, axis);
        if (setting().periodic[axis]) d -= component(size, axis) * std::nearbyint(d / component(size, axis));
        distance2 += d * d;
        outside = std::max(outside, (std::abs(d) - reach - radius) / cells_.grid(level).axis(axis).cell);
      }
      if (std::sqrt(distance2) - radius < reach && !is_gone(i)) {
        ASSERT_EQ(found[i], 1) << i;
      } else if (outside > 1.001) {
        ASSERT_EQ(found[i], 0) << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Settings, CellLists, testing::ValuesIn(kSettings),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace hooke
