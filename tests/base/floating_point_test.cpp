// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <vector>

#include "hooke/base/floating_point.h"
#include "hooke/base/parallel.h"

namespace hooke {
namespace {

#if defined(__SSE2__)

constexpr unsigned kFlushToZero = 0x9fc0;  // FTZ and DAZ, with all exceptions masked
constexpr unsigned kUpward = 0x5f80;       // rounds towards plus infinity

constexpr unsigned kModes = 0xffc0;        // all bits except the exception flags

class FloatingPointGuards : public testing::Test {
 protected:
  void TearDown() override { _mm_setcsr(saved_); }

  // Volatile, so that the compiler folds nothing at build time.
  volatile double smallest_ = std::numeric_limits<double>::min();
  volatile double one_ = 1;
  volatile double tiny_ = 1e-30;

 private:
  unsigned saved_ = _mm_getcsr();
};

TEST_F(FloatingPointGuards, KeepDenormals) {
  _mm_setcsr(kFlushToZero);
  ASSERT_EQ(smallest_ / 2, 0);
  {
    const FloatingPointGuard guard;
    EXPECT_EQ(smallest_ / 2, 0x1p-1023);
  }
  EXPECT_EQ(_mm_getcsr() & kModes, kFlushToZero & kModes) << "the caller's mode must come back";
  EXPECT_EQ(smallest_ / 2, 0);
}

TEST_F(FloatingPointGuards, RoundToNearest) {
  _mm_setcsr(kUpward);
  ASSERT_GT(one_ + tiny_, 1);
  const FloatingPointGuard guard;
  EXPECT_EQ(one_ + tiny_, 1);
}

TEST_F(FloatingPointGuards, HoldOnEveryThreadOfAParallelLoop) {
  _mm_setcsr(kFlushToZero);
  std::atomic<int> flushed{0};
  parallel_ranges(1000, 1, [&](std::size_t, std::size_t) {
    if (smallest_ / 2 == 0) ++flushed;
  });
  EXPECT_EQ(flushed, 0);
}

#endif

TEST(ParallelRanges, CoverEverythingOnceInWholeGrains) {
  for (const std::size_t count : {0UL, 1UL, 2UL, 17UL, 63UL, 64UL, 65UL, 1000UL}) {
    for (const std::size_t grain : {1UL, 16UL, 64UL}) {
      std::vector<std::atomic<int>> visits(count);
      std::atomic<int> ragged{0};
      parallel_ranges(count, grain, [&](std::size_t first, std::size_t last) {
        if (first % grain != 0 || (last % grain != 0 && last != count)) ++ragged;
        for (std::size_t i = first; i < last; ++i) ++visits[i];
      });
      EXPECT_EQ(ragged, 0);
      for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(visits[i], 1) << count << ' ' << grain << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace hooke
