// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Threads and parallel_ranges() by oneTBB. threads_std.cpp replaces this file in a build without it.
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <optional>
#include <thread>

#include "hooke/base/assert.h"
#include "hooke/base/floating_point.h"
#include "hooke/base/parallel.h"
#include "hooke/base/threads.h"

namespace hooke {

struct Threads::Arena {
  explicit Arena(int count) : arena(count) {
    const auto cores = static_cast<int>(std::thread::hardware_concurrency());
    if (count > cores) {
      control.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count));
    }
  }

  std::optional<tbb::global_control> control;
  tbb::task_arena arena;
};

Threads::Threads(int count) : count_(count), arena_(std::make_unique<Arena>(count)) { HOOKE_ASSERT(count >= 1, count); }
Threads::~Threads() = default;

void Threads::run(const void* body, void (*call)(const void* body)) {
  arena_->arena.execute([&] {
    const FloatingPointGuard guard;
    call(body);
  });
}

void run_ranges(std::size_t count, std::size_t grain, const void* body, RangeFunction call) {
  HOOKE_ASSERT(grain > 0, count);
  const std::size_t blocks = (count + grain - 1) / grain;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks), [&](const tbb::blocked_range<std::size_t>& r) {
    const FloatingPointGuard guard;
    call(body, r.begin() * grain, r.end() * grain < count ? r.end() * grain : count);
  });
}

}  // namespace hooke
