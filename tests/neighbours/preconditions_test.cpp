// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
//
// A broken precondition is reported where it is broken: one test for each kind of precondition that headers state.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hooke/neighbours/cell_grid.h"
#include "hooke/neighbours/cell_list.h"
#include "hooke/neighbours/motion_bounds.h"
#include "hooke/neighbours/neighbour_list.h"
#include "support/assertions.h"

namespace hooke {
namespace {

constexpr bool kNoAxis[3] = {false, false, false};

CellGrid grid() {
  CellGrid laid_out;
  laid_out.lay_out({0, 0, 0}, {4, 4, 4}, kNoAxis, 1);
  return laid_out;
}

CellList list() {
  CellList laid_out;
  const CellList::Level level{0.5, 1};
  laid_out.lay_out({0, 0, 0}, {4, 4, 4}, kNoAxis, std::span(&level, 1), 10);
  return laid_out;
}

TEST(NeighboursPreconditions, GridsHaveABoxAndAReach) {
  CellGrid g;
  EXPECT_ASSERTS(g.lay_out({0, 0, 0}, {4, 4, 4}, kNoAxis, 0), "reach = (0, 0, 0)");
  EXPECT_ASSERTS(g.lay_out({0, 5, 0}, {4, 4, 4}, kNoAxis, 1), "i = 1, min = (0, 5, 0), max = (4, 4, 4)");
  EXPECT_ASSERTS(g.lay_out({0, 0, 0}, {4, INFINITY, 4}, kNoAxis, 1), "max = (4, inf, 4)");
}

TEST(NeighboursPreconditions, PointsAreFinite) {
  const CellGrid g = grid();
  EXPECT_ASSERTS((void)g.key_of({0, NAN, 0}), "x = (0, nan, 0)");
  EXPECT_ASSERTS((void)g.path_key_of({0, NAN, 0}), "x = (0, nan, 0)");
}

TEST(NeighboursPreconditions, KeysAreTheGrids) {
  const CellGrid g = grid();
  CellGrid::KeyRange ranges[CellGrid::kMostRanges];
  EXPECT_ASSERTS((void)g.neighbour_ranges(g.key_end(), ranges), "key < key_end()");
  CellList cells = list();
  std::vector<std::uint32_t> order;
  EXPECT_ASSERTS(cells.sort(1, [&](std::size_t) { return cells.key_end() + 1; }, order), "i = 0");
}

TEST(NeighboursPreconditions, ACursorStaysWithItsKeys) {
  KeyCursor cursor;
  EXPECT_EQ(cursor.seek(std::vector<std::uint64_t>{1, 2, 3}, 9), 3U);
  EXPECT_ASSERTS((void)cursor.seek({}, 9), "at_ = 3, keys.size() = 0");
}

TEST(NeighboursPreconditions, LevelsAreTheLists) {
  const CellList cells = list();
  std::vector<SearchRange> found;
  EXPECT_ASSERTS((void)cells.key_of({0, 0, 0}, 1), "level = 1, level_count() = 1");
  EXPECT_ASSERTS((void)cells.find(1, {0, 0, 0}, {1, 1, 1}, found), "level = 1");
  CellList other;
  const CellList::Level flat{0.5, 0};
  EXPECT_ASSERTS(other.lay_out({0, 0, 0}, {4, 4, 4}, kNoAxis, std::span(&flat, 1), 10), "level.cell = 0");
}

TEST(NeighboursPreconditions, EachWindowHasAFrame) {
  MotionBounds<double> bounds;
  const double zeros[2] = {0, 0};
  MotionBounds<double>::Limits limits;
  limits.max = {4, 4, 4};
  bounds.lay_out({zeros, zeros, zeros}, 2, 1, limits);
  std::vector<MotionBounds<double>::Frame> one(1);
  const auto still = [](std::size_t) { return MotionBounds<double>::WindowMotion{}; };
  EXPECT_ASSERTS((void)bounds.follow(still, one), "frames.size() = 1, window_count() = 2");
  EXPECT_ASSERTS(bounds.lay_out({zeros, zeros, zeros}, 2, 0, limits), "window > 0");
  limits.skin = -1;
  EXPECT_ASSERTS(bounds.lay_out({zeros, zeros, zeros}, 2, 1, limits), "limits.skin = -1");
}

TEST(NeighboursPreconditions, RowsAreThoseOfATile) {
  NeighbourList rows;
  rows.clear(1);
  EXPECT_ASSERTS((void)rows.rows(1, 0), "s = 1, tiles.size() = 1");
  EXPECT_ASSERTS((void)rows.rows(0, NeighbourList::kSlices), "g = 64");
  NeighbourList::Writer writer(rows);
  for (std::size_t g = 0; g < NeighbourList::kSlices; ++g) (void)writer.next_slice(1);
  EXPECT_ASSERTS((void)writer.next_slice(1), "slice_ = 64");
}

}  // namespace
}  // namespace hooke
