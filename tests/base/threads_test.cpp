// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/base/threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include "hooke/base/parallel.h"

namespace hooke {
namespace {

// Adds one to each entry, in ranges.
void count_visits(std::vector<int>& visits, std::size_t grain) {
  parallel_ranges(visits.size(), grain, [&](std::size_t first, std::size_t last) {
    EXPECT_LT(first, last);
    EXPECT_EQ(first % grain, 0U);
    for (std::size_t i = first; i < last; ++i) ++visits[i];
  });
}

TEST(Threads, AnyNumberOfThreadsVisitsEachEntryOnce) {
  for (const int count : {1, 2, 3, 8}) {
    Threads threads(count);
    EXPECT_EQ(threads.count(), count);
    for (const std::size_t size : {0U, 1U, 7U, 64U, 1000U, 100000U}) {
      for (const std::size_t grain : {1U, 16U, 5000U}) {
        std::vector<int> visits(size);
        threads.run([&] { count_visits(visits, grain); });
        EXPECT_EQ(visits, std::vector<int>(size, 1)) << count << " threads, " << size << " by " << grain;
      }
    }
  }
}

TEST(Threads, AnyNumberOfThreadsMayNestRanges) {
  Threads threads(3);
  std::atomic<int> visits{0};
  threads.run([&] {
    parallel_ranges(20, 1, [&](std::size_t first, std::size_t last) {
      for (; first < last; ++first) parallel_ranges(10, 1, [&](std::size_t a, std::size_t b) { visits += int(b - a); });
    });
  });
  EXPECT_EQ(visits, 200);
}

TEST(Threads, AnyNumberOfThreadsCanShareThemOrHaveNone) {
  std::vector<std::vector<int>> visits(6, std::vector<int>(50000));
  std::vector<std::thread> callers;
  for (auto& own : visits) callers.emplace_back([&] { count_visits(own, 16); });  // on all cores, side by side
  for (std::thread& caller : callers) caller.join();
  for (const auto& own : visits) EXPECT_EQ(own, std::vector<int>(50000, 1));
}

TEST(Threads, PassOnWhatABodyThrows) {
  Threads threads(2);
  const auto fail_at = [&](std::size_t bad) {
    threads.run([&] {
      parallel_ranges(100, 1, [&](std::size_t first, std::size_t last) {
        if (first <= bad && bad < last) throw std::runtime_error("bad");
      });
    });
  };
  EXPECT_THROW(fail_at(0), std::runtime_error);
  EXPECT_THROW(fail_at(99), std::runtime_error);
  EXPECT_NO_THROW(fail_at(100));
}

}  // namespace
}  // namespace hooke
