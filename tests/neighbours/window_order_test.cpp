// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/neighbours/window_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "hooke/base/random.h"

namespace hooke {
namespace {

// The number of neighbours of the particle in a slot.
std::uint8_t count_of(std::size_t slot) { return static_cast<std::uint8_t>(256 * uniform4(61, slot, 0)[0]); }

// The previous slots of points in cell order: a random order.
std::vector<std::uint32_t> some_order(std::size_t count) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [](auto a, auto b) { return uniform4(62, a, 0)[0] < uniform4(62, b, 0)[0]; });
  return order;
}

class WindowOrders : public testing::TestWithParam<std::size_t> {
 protected:
  // Lays out points in `order`, which becomes the slots' order. Returns the order before.
  std::vector<std::uint32_t> lay_out(std::vector<std::uint32_t>& order) {
    std::vector<std::uint32_t> before = order;
    slots_.lay_out(order);
    return before;
  }
  WindowOrder slots_;
};

TEST_P(WindowOrders, AreCellOrderWhereNothingIsKnown) {
  std::vector<std::uint32_t> order = some_order(GetParam());
  EXPECT_EQ(lay_out(order), order);
  for (std::size_t p = 0; p < order.size(); ++p) ASSERT_EQ(slots_.slot_of(p), p);
}

TEST_P(WindowOrders, PutThoseWithMostNeighboursFirst) {
  std::vector<std::uint32_t> order = some_order(GetParam());
  lay_out(order);
  for (std::size_t slot = 0; slot < order.size(); ++slot) slots_.neighbour_counts()[slot] = count_of(slot);
  order = some_order(GetParam());
  const std::vector<std::uint32_t> before = lay_out(order);
  for (std::size_t first = 0; first < order.size(); first += kWindow) {
    const auto begin = before.begin() + static_cast<std::ptrdiff_t>(first);
    std::vector<std::uint32_t> expected(begin,
                                        begin + static_cast<std::ptrdiff_t>(std::min(kWindow, order.size() - first)));
    std::stable_sort(expected.begin(), expected.end(), [](auto a, auto b) { return count_of(a) > count_of(b); });
    for (std::size_t k = 0; k < expected.size(); ++k) ASSERT_EQ(order[first + k], expected[k]) << first << " + " << k;
  }
  for (std::size_t p = 0; p < before.size(); ++p) ASSERT_EQ(order[slots_.slot_of(p)], before[p]) << p;
}

// More points than were listed before: the new points' numbers of neighbours are unknown.
TEST_P(WindowOrders, CountTheUnknownAsAlone) {
  std::vector<std::uint32_t> order = some_order(GetParam());
  lay_out(order);
  for (std::size_t slot = 0; slot < order.size(); ++slot) slots_.neighbour_counts()[slot] = 5;
  std::vector<std::uint32_t> more = some_order(GetParam() + 40);
  const std::vector<std::uint32_t> before = lay_out(more);
  const auto is_new = [&](std::uint32_t slot) { return slot >= order.size(); };
  for (std::size_t first = 0; first < more.size(); first += kWindow) {
    const auto begin = more.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = begin + static_cast<std::ptrdiff_t>(std::min(kWindow, more.size() - first));
    EXPECT_TRUE(std::is_partitioned(begin, end, [&](std::uint32_t slot) { return !is_new(slot); })) << first;
  }
  for (std::size_t p = 0; p < before.size(); ++p) ASSERT_EQ(more[slots_.slot_of(p)], before[p]) << p;
}

INSTANTIATE_TEST_SUITE_P(Counts, WindowOrders, testing::Values(0, 1, 17, 63, 64, 65, 1000, 5000));

}  // namespace
}  // namespace hooke
