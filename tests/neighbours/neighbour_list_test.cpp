// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/neighbours/neighbour_list.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "hooke/base/random.h"

namespace hooke {
namespace {

constexpr std::uint32_t kDummy = 0xfffffff0U;

// Points for the list: positions in the order of their cells, ranks in another.
template <class Real>
struct Cloud {
  std::vector<Vec3<Real>> x;
  std::vector<Real> r;
  std::vector<std::uint32_t> ranks;

  Vec3<Real> position(std::size_t i) const { return x[i]; }
  Real radius(std::size_t i) const { return r[i]; }
  std::uint32_t rank(std::size_t i) const { return ranks[i]; }
};

struct Setting {
  const char* name;
  std::size_t count;
  Vec3d min, max;
  bool periodic[3];
  Vec3d spread;  // part of the box that points lie in, an axis
  double radius, ratio;  // radii from radius to ratio times that
};

void PrintTo(const Setting& setting, std::ostream* os) { *os << setting.name; }

const Setting kSettings[] = {
    {"nothing", 0, {0, 0, 0}, {5, 5, 5}, {false, false, false}, {1, 1, 1}, 0.5, 1},
    {"one", 1, {0, 0, 0}, {5, 5, 5}, {false, false, false}, {1, 1, 1}, 0.5, 1},
    {"two", 2, {0, 0, 0}, {1, 1, 1}, {false, false, false}, {1, 1, 1}, 0.5, 1},
    {"seventeen", 17, {0, 0, 0}, {2, 2, 2}, {false, false, false}, {1, 1, 1}, 0.5, 1},
    {"a_segment", 1024, {0, 0, 0}, {9, 9, 9}, {false, false, false}, {1, 1, 1}, 0.5, 1},
    {"many", 3001, {0, 0, 0}, {12, 14, 16}, {false, false, false}, {1, 1, 1}, 0.5, 1},
    {"mixed_radii", 2001, {0, 0, 0}, {12, 14, 16}, {false, false, false}, {1, 1, 1}, 0.2, 4},
    {"negative", 2001, {-1012, -14, -160}, {-1000, -1, -144}, {false, false, false}, {1, 1, 1}, 0.5, 1.5},
    {"sparse", 500, {-5e5, -5e5, -5e5}, {5e5, 5e5, 5e5}, {false, false, false}, {1, 1, 1}, 0.5, 1},
    {"one_cell", 300, {0, 0, 0}, {100, 100, 100}, {false, false, false}, {0.005, 0.005, 0.005}, 0.5, 1},
    {"one_spot", 100, {0, 0, 0}, {100, 100, 100}, {false, false, false}, {0, 0, 0}, 0.5, 1},
    {"line", 400, {0, 0, 0}, {200, 10, 10}, {false, false, false}, {1, 0, 0}, 0.5, 1},
    {"plane", 900, {0, 0, 0}, {40, 10, 40}, {false, false, false}, {1, 0, 1}, 0.5, 1},
    {"periodic", 2001, {0, 0, 0}, {12, 11, 10}, {true, true, true}, {1, 1, 1}, 0.5, 1.2},
    {"periodic_three_cells", 100, {0, 0, 0}, {4, 4, 4}, {true, true, true}, {1, 1, 1}, 0.5, 1},
    {"periodic_two_cells", 60, {-1, 0, 0}, {1.6, 2.6, 2.7}, {true, true, true}, {1, 1, 1}, 0.5, 1},
    {"periodic_one_cell", 40, {0, 0, 0}, {1.3, 2, 1}, {true, true, true}, {1, 1, 1}, 0.5, 1},
    {"periodic_x", 1000, {0, 0, 0}, {3.8, 20, 8}, {true, false, false}, {1, 1, 1}, 0.5, 1},
    {"periodic_z", 1000, {0, 0, 0}, {8, 20, 2.5}, {false, false, true}, {1, 1, 1}, 0.5, 1},
};

template <class Real>
class Lists {
 public:
  explicit Lists(const Setting& setting) : setting_(setting) {
    const Vec3d size = setting.max - setting.min;
    std::vector<Vec3<Real>> x;
    for (std::size_t i = 0; i < setting.count; ++i) {
      const auto u = uniform4(11, i, 0);
      x.push_back(vec_cast<Real>(setting.min + Vec3d{setting.spread.x * u[0] * size.x, setting.spread.y * u[1] * size.y,
                                                     setting.spread.z * u[2] * size.z}));
    }
    grid_.lay_out(setting.min, setting.max, setting.periodic,
                  (2 * setting.radius * setting.ratio + kSkin * setting.radius) * (1 + 1e-6));
    for (const auto& p : x) keys_.push_back(grid_.key_of(vec_cast<double>(p)));
    std::vector<std::uint32_t> order;
    sort_by_key(keys_, order);
    for (std::size_t i = 0; i < setting.count; ++i) {
      cloud_.x.push_back(x[order[i]]);
      cloud_.ranks.push_back(order[i]);
      const double part = uniform4(12, order[i], 0)[0];
      cloud_.r.push_back(static_cast<Real>(setting.radius * (1 + (setting.ratio - 1) * part)));
    }
    search_.count = setting.count;
    search_.keys = keys_;
    search_.grid = &grid_;
    search_.skin = static_cast<Real>(kSkin * setting.radius);
    std::copy(std::begin(setting.periodic), std::end(setting.periodic), search_.periodic);
    search_.length = vec_cast<Real>(size);
    search_.dummy = kDummy;
  }

  void build(bool list_self, NeighbourList& list) {
    search_.list_self = list_self;
    build_neighbour_list(search_, cloud_, [](std::uint32_t i) { return i; }, list);
  }

  // Every pair looked at: the points nearer to i than their radii and the skin, by rank.
  std::vector<std::uint32_t> expected(std::size_t i, bool list_self) const {
    std::vector<std::uint32_t> near;
    for (std::size_t p = 0; p < cloud_.x.size(); ++p) {
      if (p == i && !list_self) continue;
      Real sum = 0;
      for (int axis = 0; axis < 3; ++axis) {
        Real d = component(cloud_.x[i], axis) - component(cloud_.x[p], axis);
        const Real length = component(search_.length, axis);
        if (search_.periodic[axis] && d > length / 2) d -= length;
        if (search_.periodic[axis] && d < -length / 2) d += length;
        sum += d * d;
      }
      const Real reach = cloud_.r[i] + (cloud_.r[p] + search_.skin);
      if (sum < reach * reach) near.push_back(static_cast<std::uint32_t>(p));
    }
    std::sort(near.begin(), near.end(), [&](auto a, auto b) { return cloud_.ranks[a] < cloud_.ranks[b]; });
    return near;
  }

  // Into a list that may have held others before.
  void check(bool list_self, NeighbourList& list) {
    build(list_self, list);
    ASSERT_EQ(list.segments.size(), (setting_.count + NeighbourList::kSegment - 1) / NeighbourList::kSegment);
    for (std::size_t i = 0; i < setting_.count; ++i) {
      const NeighbourList::Segment& segment = list.segments[i / NeighbourList::kSegment];
      const std::size_t group = i % NeighbourList::kSegment / NeighbourList::kLanes;
      std::vector<std::uint32_t> lane;
      for (std::size_t row = segment.first_row[group]; row < segment.first_row[group + 1]; ++row) {
        lane.push_back(segment.entries[row * NeighbourList::kLanes + i % NeighbourList::kLanes]);
      }
      while (!lane.empty() && lane.back() == kDummy) lane.pop_back();
      ASSERT_EQ(lane, expected(i, list_self)) << "point " << i;
    }
  }

 private:
  static constexpr double kSkin = 0.5;  // of the smallest radius

  Setting setting_;
  CellGrid grid_;
  std::vector<std::uint64_t> keys_;
  Cloud<Real> cloud_;
  NeighbourSearch<Real> search_;
};

class NeighbourLists : public testing::TestWithParam<Setting> {};

TEST_P(NeighbourLists, HoldTheNearAndNoOthersByRank) {
  NeighbourList list;
  Lists<double>(GetParam()).check(false, list);
  Lists<float>(GetParam()).check(false, list);
}

TEST_P(NeighbourLists, HoldThePointItselfWhereAsked) {
  NeighbourList list;
  Lists<double>(GetParam()).check(true, list);
}

INSTANTIATE_TEST_SUITE_P(Settings, NeighbourLists, testing::ValuesIn(kSettings),
                         [](const auto& instance) { return instance.param.name; });

// Memory is kept from one build to the next, whatever their sizes.
TEST(NeighbourList, CanBeBuiltAgainAndAgain) {
  NeighbourList list;
  for (int round = 0; round < 2; ++round) {
    for (const Setting& setting : kSettings) Lists<double>(setting).check(false, list);
  }
}

TEST(NeighbourList, CountsItsEntriesWithTheirPadding) {
  NeighbourList list;
  EXPECT_EQ(list.entry_count(), 0U);
  Lists<double>(kSettings[2]).check(false, list);  // two points that are neighbours: one row
  EXPECT_EQ(list.entry_count(), NeighbourList::kLanes);
  Lists<double>(kSettings[0]).check(false, list);
  EXPECT_EQ(list.entry_count(), 0U);
}

}  // namespace
}  // namespace hooke
