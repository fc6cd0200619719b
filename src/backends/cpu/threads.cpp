// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/threads.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <optional>
#include <thread>

#include "hooke/base/assert.h"
#include "hooke/base/floating_point.h"

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

}  // namespace hooke
