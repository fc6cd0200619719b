// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/base/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#if defined(HOOKE_SANITIZE_THREAD)
#include <tbb/task_arena.h>

#include <atomic>
#include <thread>
#include <vector>
#endif

#include "hooke/base/assert.h"
#include "hooke/base/floating_point.h"

namespace hooke {

void run_ranges(std::size_t count, std::size_t grain, const void* body, RangeFunction call) {
  HOOKE_ASSERT(grain > 0, count);
  const std::size_t blocks = (count + grain - 1) / grain;
  const auto run_blocks = [&](std::size_t first, std::size_t last) {
    const FloatingPointGuard guard;
    call(body, first * grain, last * grain < count ? last * grain : count);
  };
#if defined(HOOKE_SANITIZE_THREAD)
  // The thread sanitizer can't see how an uninstrumented oneTBB hands work over, and reports it all as races.
  std::atomic<std::size_t> next{0};
  std::vector<std::thread> threads(static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()));
  for (std::thread& thread : threads) {
    thread = std::thread([&] {
      for (std::size_t block = next++; block < blocks; block = next++) run_blocks(block, block + 1);
    });
  }
  for (std::thread& thread : threads) thread.join();
#else
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks),
                    [&](const tbb::blocked_range<std::size_t>& r) { run_blocks(r.begin(), r.end()); });
#endif
}

}  // namespace hooke
