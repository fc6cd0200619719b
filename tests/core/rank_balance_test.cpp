// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// When ranks share their work out anew.

#include "hooke/core/rank_balance.h"

#include <gtest/gtest.h>

#include <vector>

namespace hooke {
namespace {

// What some ranks do in each step: the work, and the seconds that it takes.
struct Doing {
  double work, seconds;
};

class SomeRanks {
 public:
  explicit SomeRanks(std::size_t count) : balances_(count, RankBalance(static_cast<int>(count))) {}

  // So many steps and an exchange. Whether all ranks cut, which they have to agree about.
  bool exchange_after(int steps, const std::vector<Doing>& doing) {
    RankBalance::Interval all;
    for (std::size_t r = 0; r < doing.size(); ++r) {
      for (int k = 0; k < steps; ++k) balances_[r].add_step(doing[r].seconds, doing[r].work);
      all.add(balances_[r].interval(static_cast<std::uint64_t>(doing[r].work)));
    }
    uneven_time = all.seconds.uneven(static_cast<int>(doing.size()));
    RankBalance::Spread loads;
    for (std::size_t r = 0; r < doing.size(); ++r) {
      balances_[r].end_interval(all);
      loads.add(RankBalance::Spread::of(balances_[r].slowness() * doing[r].work));
    }
    bool cut = false;
    for (std::size_t r = 0; r < doing.size(); ++r) {
      const bool wants = balances_[r].wants_cut(loads);
      EXPECT_TRUE(r == 0 || wants == cut);
      cut = wants;
    }
    return cut;
  }
  // All have the same load now, or the first one so many times the mean.
  void cut(const std::vector<Doing>& now, double seconds, double first = 1) {
    RankBalance::Spread loads;
    for (std::size_t r = 0; r < now.size(); ++r) loads.add(RankBalance::Spread::of(r == 0 ? 1e4 * first : 1e4));
    for (std::size_t r = 0; r < now.size(); ++r)
      balances_[r].begin_anew(loads, 1e4 / now[r].work, now[r].work, seconds);
  }
  double slowness(std::size_t rank) const { return balances_[rank].slowness(); }

  double uneven_time = 0;  // of the last interval

 private:
  std::vector<RankBalance> balances_;
};

TEST(RankBalance, ComparesTheLargestWithTheMean) {
  RankBalance::Spread loads = RankBalance::Spread::of(30);
  loads.add(RankBalance::Spread::of(10));
  EXPECT_DOUBLE_EQ(loads.uneven(2), 1.5);
  EXPECT_DOUBLE_EQ(loads.uneven(2, 10), 1.0);
  EXPECT_DOUBLE_EQ(RankBalance::Spread{}.uneven(2), 1);
}

// Of equal work, one rank's takes twice as long.
TEST(RankBalance, CutsWhereWorkIsDear) {
  SomeRanks ranks(2);
  const std::vector<Doing> doing = {{10'000, 2e-3}, {10'000, 1e-3}};
  EXPECT_FALSE(ranks.exchange_after(10, doing)) << "a few steps tell little";
  EXPECT_EQ(ranks.slowness(0), 1);
  EXPECT_TRUE(ranks.exchange_after(90, doing));
  EXPECT_NEAR(ranks.slowness(0), 4.0 / 3, 0.01);
  EXPECT_NEAR(ranks.slowness(1), 2.0 / 3, 0.01);
  EXPECT_NEAR(ranks.uneven_time, 4.0 / 3, 1e-12);
  const std::vector<Doing> evened = {{7'500, 1.5e-3}, {15'000, 1.5e-3}};
  ranks.cut(evened, 1e-3);
  for (int k = 0; k < 50; ++k) EXPECT_FALSE(ranks.exchange_after(10, evened));
}

// The cut was made for dear particles, but the rank is slow whatever it has.
TEST(RankBalance, LearnsWhatACutHasBrought) {
  SomeRanks ranks(2);
  EXPECT_TRUE(ranks.exchange_after(100, {{10'000, 2e-3}, {10'000, 1e-3}}));
  const std::vector<Doing> now = {{7'500, 1.5e-3}, {12'500, 1.25e-3}};
  ranks.cut(now, 0);
  int exchanges = 0;
  while (!ranks.exchange_after(10, now) && exchanges < 100) ++exchanges;
  EXPECT_LT(exchanges, 20);
  EXPECT_NEAR(ranks.slowness(0) / ranks.slowness(1), 2, 0.3);
}

TEST(RankBalance, CountsWhereClocksStandStill) {
  SomeRanks ranks(4);
  EXPECT_FALSE(ranks.exchange_after(100, {{10'400, 0}, {10'000, 0}, {10'000, 0}, {9'900, 0}}));
  EXPECT_TRUE(ranks.exchange_after(1, {{10'900, 0}, {10'000, 0}, {10'000, 0}, {9'900, 0}}));
  EXPECT_EQ(ranks.slowness(0), 1);
  EXPECT_FALSE(ranks.exchange_after(1, {{60, 0}, {0, 0}, {0, 0}, {0, 0}})) << "a few don't matter";
}

TEST(RankBalance, DoesNotTryWhatACutCantHelp) {
  SomeRanks ranks(2);
  const std::vector<Doing> doing = {{13'000, 0}, {7'000, 0}};
  EXPECT_TRUE(ranks.exchange_after(10, doing));
  ranks.cut(doing, 0, 1.9);  // 1.31 times the mean is what is left
  EXPECT_FALSE(ranks.exchange_after(10, doing));
  EXPECT_FALSE(ranks.exchange_after(10, {{13'500, 0}, {6'500, 0}}));
  EXPECT_TRUE(ranks.exchange_after(10, {{14'500, 0}, {5'500, 0}}));
}

// One that takes as long as 100 steps is worth it when as much has been lost.
TEST(RankBalance, WaitsUntilADearCutPays) {
  SomeRanks ranks(2);
  const std::vector<Doing> even = {{10'000, 1e-3}, {10'000, 1e-3}};
  EXPECT_FALSE(ranks.exchange_after(100, even));
  ranks.cut(even, 0.1);
  const std::vector<Doing> uneven = {{12'000, 1.2e-3}, {8'000, 0.8e-3}};  // 0.2 ms a step are lost
  int steps = 10;
  while (!ranks.exchange_after(10, uneven) && steps < 10'000) steps += 10;
  EXPECT_NEAR(steps, 510, 15);
}

TEST(RankBalance, BelievesNoRankToBeManyTimesAsSlow) {
  SomeRanks ranks(2);
  (void)ranks.exchange_after(100, {{1'000, 1}, {100'000, 1e-3}});
  EXPECT_EQ(ranks.slowness(0), 4);
  EXPECT_EQ(ranks.slowness(1), 0.25);
}

}  // namespace
}  // namespace hooke
