// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Threads and parallel_ranges() by the C++ library alone: in a build without oneTBB, and under the thread sanitizer,
// which can't see how an uninstrumented oneTBB hands work over.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/base/floating_point.h"
#include "hooke/base/parallel.h"
#include "hooke/base/threads.h"

namespace hooke {

namespace {

/// The blocks of one parallel_ranges(). Whoever works on it takes the next few of them until none is left.
class Job {
 public:
  Job(std::size_t count, std::size_t grain, const void* body, RangeFunction call)
      : count_(count),
        grain_(grain),
        blocks_((count + grain - 1) / grain),
        body_(body),
        call_(call) {}

  std::size_t blocks() const { return blocks_; }

  /// Lets none of the body's exceptions out; ends early if another thread had one.
  void work(std::size_t share) noexcept {
    const FloatingPointGuard guard;
    try {
      for (std::size_t first = next_.fetch_add(share); first < blocks_; first = next_.fetch_add(share)) {
        call_(body_, first * grain_, std::min(count_, (first + share) * grain_));
      }
    } catch (...) {
      next_ = blocks_;
      const std::lock_guard lock(failure_mutex_);
      if (!failure_) failure_ = std::current_exception();
    }
  }

  /// After all work: throws the body's exception, if it had one.
  void finish() {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::size_t count_, grain_, blocks_;
  const void* body_;
  RangeFunction call_;
  std::atomic<std::size_t> next_{0};
  std::mutex failure_mutex_;
  std::exception_ptr failure_;
};

class Pool;

// The pool that parallel_ranges() of this thread runs on: that of Threads::run(), or where there is none all cores.
thread_local Pool* current = nullptr;

/// The calling thread and some more, which wait for a job.
class Pool {
 public:
  explicit Pool(int count) {
    workers_.reserve(static_cast<std::size_t>(count - 1));
    try {
      for (int i = 1; i < count; ++i) workers_.emplace_back([this] { wait_and_work(); });
    } catch (const std::system_error&) {
      // The system has no more threads to give: those that there are do the work.
    }
  }
  ~Pool() {
    job_ = nullptr;
    start();
    for (std::thread& worker : workers_) worker.join();
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  /// Does the job, alone where the other threads have one already: another thread's, or the one that this is part of.
  void run(Job& job) {
    if (workers_.empty() || job.blocks() < 2 || busy_.exchange(true)) return job.work(job.blocks());
    share_ = std::max<std::size_t>(1, job.blocks() / (kSharesPerThread * (workers_.size() + 1)));
    job_ = &job;
    working_ = workers_.size();
    start();
    job.work(share_);
    for (std::size_t left = working_.load(); left != 0; left = working_.load()) working_.wait(left);
    busy_ = false;
  }

 private:
  // Enough that a thread which is late leaves its part to the others, few enough that taking a share costs nothing.
  static constexpr std::size_t kSharesPerThread = 8;

  void start() {
    ++jobs_;
    jobs_.notify_all();
  }

  void wait_and_work() {
    current = this;
    for (std::uint64_t done = 0;; ++done) {
      jobs_.wait(done);
      if (job_ == nullptr) return;
      job_->work(share_);
      if (--working_ == 0) working_.notify_one();
    }
  }

  std::vector<std::thread> workers_;
  std::atomic<bool> busy_{false};
  Job* job_ = nullptr;  // null: the threads end
  std::size_t share_ = 1;  // blocks that a thread takes at a time
  std::atomic<std::uint64_t> jobs_{0};
  std::atomic<std::size_t> working_{0};
};

Pool& all_cores() {
  static Pool pool(std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
  return pool;
}

}  // namespace

struct Threads::Arena {
  explicit Arena(int count) : pool(count) {}
  Pool pool;
};

Threads::Threads(int count) : count_(count) {
  HOOKE_ASSERT(count >= 1, count);
  arena_ = std::make_unique<Arena>(count);
}
Threads::~Threads() = default;

void Threads::run(const void* body, void (*call)(const void* body)) {
  struct Chosen {
    explicit Chosen(Pool* pool) : before(std::exchange(current, pool)) {}
    ~Chosen() { current = before; }
    Pool* before;
  };
  const Chosen chosen(&arena_->pool);
  const FloatingPointGuard guard;
  call(body);
}

void run_ranges(std::size_t count, std::size_t grain, const void* body, RangeFunction call) {
  HOOKE_ASSERT(grain > 0, count);
  if (count == 0) return;
  Job job(count, grain, body, call);
  (current != nullptr ? *current : all_cores()).run(job);
  job.finish();
}

}  // namespace hooke
