// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/neighbours/neighbour_list.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "hooke/backends/cpu/isa.h"
#include "hooke/base/random.h"

namespace hooke {
namespace {

constexpr std::uint32_t kFiller = 0x3ffffff0U;

struct Setting {
  const char* name;
  std::size_t count;
  Vec3d min, max;
  bool periodic[3];
  Vec3d spread;  // part of the box that points lie in, along each axis
  double radius, ratio;  // radii from radius to ratio * radius
};

void PrintTo(const Setting& setting, std::ostream* os) { *os << setting.name; }

const Setting kSettings[] = {
    {"nothing", 0, {0, 0, 0}, {5, 5, 5}, {false, false, false}, {1, 1, 1}, 0.5, 1},
    {"one", 1, {0, 0, 0}, {5, 5, 5}, {false, false, false}, {1, 1, 1}, 0.5, 1},
    {"two", 2, {0, 0, 0}, {1, 1, 1}, {false, false, false}, {1, 1, 1}, 0.5, 1},
    {"seventeen", 17, {0, 0, 0}, {2, 2, 2}, {false, false, false}, {1, 1, 1}, 0.5, 1},
    {"a_tile", 1024, {0, 0, 0}, {9, 9, 9}, {false, false, false}, {1, 1, 1}, 0.5, 1},
    {"many", 3001, {0, 0, 0}, {12, 14, 16}, {false, false, false}, {1, 1, 1}, 0.5, 1},
    {"mixed_radii", 2001, {0, 0, 0}, {12, 14, 16}, {false, false, false}, {1, 1, 1}, 0.2, 4},
    {"one_to_ten", 3001, {0, 0, 0}, {12, 14, 16}, {false, false, false}, {1, 1, 1}, 0.1, 10},
    {"one_to_forty_periodic", 1501, {0, 0, 0}, {12, 14, 11}, {true, true, false}, {1, 1, 1}, 0.05, 40},
    {"one_to_ten_in_a_short_period", 501, {-1, 0, 0}, {2.6, 4.6, 4}, {true, false, true}, {1, 1, 1}, 0.1, 10},
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

constexpr double kSkin = 0.5;  // of the smallest radius

WindowSearchFunction<float> search_of(const Isa& isa, float) { return isa.single_loops.search_window; }
WindowSearchFunction<double> search_of(const Isa& isa, double) { return isa.double_loops.search_window; }

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
    // Many small points and few large ones, a level for each doubling of the radius.
    const auto radius_of = [&](std::size_t i) {
      return setting.radius * std::pow(setting.ratio, std::pow(uniform4(12, i, 0)[0], 3));
    };
    const auto level_of = [&](std::size_t i) {
      return static_cast<std::size_t>(std::log2(radius_of(i) / setting.radius));
    };
    std::vector<CellList::Level> levels;
    for (double radius = setting.radius; levels.empty() || radius < setting.radius * setting.ratio; radius *= 2) {
      const double largest = std::min(2 * radius, setting.radius * setting.ratio);
      levels.push_back({largest, 2 * largest + kSkin * setting.radius});
    }
    cells_.lay_out(setting.min, setting.max, setting.periodic, levels, setting.count);
    std::vector<std::uint32_t> order;
    cells_.sort(
        setting.count, [&](std::size_t i) { return cells_.key_of(vec_cast<double>(x[i]), level_of(i)); }, order);
    constexpr std::size_t kReadable = 16;
    for (auto* column : {&x_, &y_, &z_, &radii_}) column->resize(setting.count + kReadable);
    id_indices_.resize(setting.count + kReadable);
    places_.resize(setting.count + kReadable);
    neighbour_counts_.resize(setting.count, 77);
    for (std::size_t i = 0; i < setting.count; ++i) {
      x_[i] = x[order[i]].x;
      y_[i] = x[order[i]].y;
      z_[i] = x[order[i]].z;
      id_indices_[i] = order[i];
      places_[i] = place_of(i);
      radii_[i] = static_cast<Real>(radius_of(order[i]));
    }
    rule_.at = {x_.data(), y_.data(), z_.data()};
    rule_.radius = setting.ratio == 1 ? nullptr : radii_.data();
    rule_.id_index = id_indices_.data();
    rule_.slot_in_window = places_.data();
    rule_.neighbour_count = neighbour_counts_.data();
    rule_.reach = static_cast<Real>((kSkin + (setting.ratio == 1 ? 2 : 0)) * setting.radius);
    std::copy(std::begin(setting.periodic), std::end(setting.periodic), rule_.periodic);
    rule_.length = vec_cast<Real>(size);
    rule_.stride = kStride;
    rule_.filler = kFiller / kStride;
  }

  void build(const Isa& isa, bool list_self, NeighbourList& list) {
    rule_.list_self = list_self;
    build_neighbour_list<Real>(cells_, rule_, search_of(isa, Real{}), list);
  }

  // By a search through all points: those nearer to i than the reach, i included, by id index.
  std::vector<std::uint32_t> expected(std::size_t i) const {
    std::vector<std::uint32_t> near;
    for (std::size_t p = 0; p < setting_.count; ++p) {
      Real sum = 0;
      int axis = 0;
      for (const auto* column : {&x_, &y_, &z_}) {
        Real d = (*column)[i] - (*column)[p];
        const Real length = component(rule_.length, axis);
        if (rule_.periodic[axis] && d > length / 2) d -= length;
        if (rule_.periodic[axis] && d < -length / 2) d += length;
        sum += d * d;
        ++axis;
      }
      const Real reach = rule_.radius == nullptr ? rule_.reach : rule_.reach + radii_[i] + radii_[p];
      if (sum < reach * reach) near.push_back(static_cast<std::uint32_t>(p));
    }
    std::sort(near.begin(), near.end(), [&](auto a, auto b) { return id_indices_[a] < id_indices_[b]; });
    for (std::uint32_t& p : near) p = static_cast<std::uint32_t>(slot_of(p)) * kStride;
    return near;
  }

  // On every available instruction set, into a list that may have pinned other points before.
  void check(bool list_self, NeighbourList& list) {
    std::vector<std::vector<std::uint32_t>> near;
    for (std::size_t i = 0; i < setting_.count; ++i) near.push_back(expected(i));
    for (const Isa& isa : available_isas()) check(isa, list_self, near, list);
  }

 private:
  void check(const Isa& isa, bool list_self, const std::vector<std::vector<std::uint32_t>>& near, NeighbourList& list) {
    build(isa, list_self, list);
    ASSERT_EQ(list.tiles.size(), (setting_.count + NeighbourList::kTile - 1) / NeighbourList::kTile);
    for (std::size_t i = 0; i < setting_.count; ++i) {
      const std::size_t slot = slot_of(i);
      const NeighbourList::Tile& tile = list.tiles[slot / NeighbourList::kTile];
      ASSERT_NE(tile.entries, nullptr) << "as if particles were not listed";
      const std::size_t slice = slot % NeighbourList::kTile / NeighbourList::kLanes;
      std::vector<std::uint32_t> lane;
      for (std::size_t row = tile.first_row[slice]; row < tile.first_row[slice + 1]; ++row) {
        lane.push_back(tile.entries[row * NeighbourList::kLanes + slot % NeighbourList::kLanes]);
      }
      while (!lane.empty() && lane.back() == kFiller) lane.pop_back();
      std::vector<std::uint32_t> listed = near[i];
      if (!list_self) std::erase(listed, static_cast<std::uint32_t>(slot) * kStride);
      ASSERT_EQ(lane, listed) << isa.name << ", point " << i;
      ASSERT_EQ(neighbour_counts_[slot], std::min<std::size_t>(near[i].size(), 255)) << isa.name;
    }
  }

  static constexpr std::uint32_t kStride = 4;

  // In every other window the order is reversed.
  std::uint8_t place_of(std::size_t i) const {
    const std::size_t first = i / kWindow * kWindow, last = std::min(first + kWindow, setting_.count) - 1;
    return static_cast<std::uint8_t>(i / kWindow % 2 == 0 ? last - i : i - first);
  }
  std::size_t slot_of(std::size_t i) const { return i / kWindow * kWindow + places_[i]; }

  Setting setting_;
  CellList cells_;
  std::vector<Real> x_, y_, z_, radii_;
  std::vector<std::uint32_t> id_indices_;
  std::vector<std::uint8_t> places_, neighbour_counts_;
  NeighbourRule<Real> rule_;
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
  Lists<float>(GetParam()).check(true, list);
}

INSTANTIATE_TEST_SUITE_P(Settings, NeighbourLists, testing::ValuesIn(kSettings),
                         [](const auto& instance) { return instance.param.name; });

// Memory is kept from one build to the next, for builds of any size.
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
