// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <memory>
#include <thread>

#include "hooke/base/assert.h"
#include "hooke/base/floating_point.h"

namespace hooke {

/// Threads to run on, one at least, also where more are asked for than the machine has cores.
class Threads {
 public:
  explicit Threads(int count) : count_(count), arena_(count) {
    HOOKE_ASSERT(count >= 1, count);
    const auto cores = static_cast<int>(std::thread::hardware_concurrency());
    if (count > cores) {
      control_ = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                       static_cast<std::size_t>(count));
    }
  }

  int count() const { return count_; }

  /// body() on these threads, with Hooke's floating-point modes.
  template <class Body>
  void run(const Body& body) {
    arena_.execute([&] {
      const FloatingPointGuard guard;
      body();
    });
  }

 private:
  int count_;
  std::unique_ptr<tbb::global_control> control_;
  tbb::task_arena arena_;
};

}  // namespace hooke
