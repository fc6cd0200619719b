// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/simulation_thread.h"

#include <condition_variable>
#include <deque>
#include <limits>
#include <mutex>
#include <thread>

#include "hooke/base/assert.h"

namespace hooke {

struct SimulationThread::Impl {
  enum class End { none, now, after_commands };
  static constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

  Simulation simulation;  // the thread's own, once it runs
  std::shared_ptr<const Snapshot> mailbox;

  mutable std::mutex mutex;  // of the mailbox and all below
  std::condition_variable changed;
  std::deque<Command> commands;
  std::int64_t steps_left;  // 0 while paused
  bool wanted = false;  // a newer state in the mailbox
  End end = End::none;
  std::optional<Error> failure;
  std::thread thread;

  Impl(Simulation started, bool paused)
      : simulation(std::move(started)),
        mailbox(simulation.snapshot()),
        steps_left(paused ? 0 : kNoLimit),
        thread([this] { work(); }) {}

  void work() {
    std::unique_lock lock(mutex);
    for (;;) {
      changed.wait(lock, [&] { return end != End::none || !commands.empty() || steps_left > 0 || wanted; });
      if (end == End::now || (end == End::after_commands && commands.empty())) return;
      carry_out_commands(lock);
      if (steps_left > 0 && end == End::none) take_step(lock);
      if (wanted) publish(lock);
    }
  }

  // Those that have come so far: others have a step between.
  void carry_out_commands(std::unique_lock<std::mutex>& lock) {
    std::deque<Command> now;
    now.swap(commands);
    if (now.empty()) return;
    lock.unlock();
    for (const Command& command : now) command(simulation);
    lock.lock();
  }

  void take_step(std::unique_lock<std::mutex>& lock) {
    lock.unlock();
    Expected<void> taken = simulation.step();
    lock.lock();
    failure.reset();
    if (!taken) failure = std::move(taken).error();
    if (failure) steps_left = 0;
    if (steps_left > 0 && steps_left != kNoLimit) --steps_left;
  }

  void publish(std::unique_lock<std::mutex>& lock) {
    wanted = false;
    lock.unlock();
    std::shared_ptr<const Snapshot> now = simulation.snapshot();
    lock.lock();
    mailbox = std::move(now);
  }

  template <class Change>
  void change(const Change& what) {
    {
      const std::lock_guard lock(mutex);
      what();
    }
    changed.notify_all();
  }

  void stop(End how) {
    change([&] { end = how; });
    if (thread.joinable()) thread.join();
  }
};

SimulationThread::SimulationThread(Simulation simulation, bool paused)
    : impl_(std::make_unique<Impl>(std::move(simulation), paused)) {}

SimulationThread::~SimulationThread() {
  if (impl_) impl_->stop(Impl::End::now);
}

void SimulationThread::post(Command command) {
  HOOKE_ASSERT(command != nullptr);
  impl_->change([&] { impl_->commands.push_back(std::move(command)); });
}

void SimulationThread::pause() {
  impl_->change([&] { impl_->steps_left = 0; });
}

void SimulationThread::resume() {
  impl_->change([&] { impl_->steps_left = Impl::kNoLimit; });
}

void SimulationThread::step(std::int64_t count) {
  HOOKE_ASSERT(count > 0, count);
  impl_->change([&] { impl_->steps_left = impl_->steps_left == Impl::kNoLimit ? count : impl_->steps_left + count; });
}

bool SimulationThread::is_paused() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->steps_left == 0;
}

std::shared_ptr<const Snapshot> SimulationThread::latest() {
  std::shared_ptr<const Snapshot> now;
  impl_->change([&] {
    impl_->wanted = true;
    now = impl_->mailbox;
  });
  return now;
}

std::optional<Error> SimulationThread::failure() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->failure;
}

Simulation SimulationThread::finish() {
  impl_->stop(Impl::End::after_commands);
  Simulation simulation = std::move(impl_->simulation);
  impl_.reset();
  return simulation;
}

}  // namespace hooke
