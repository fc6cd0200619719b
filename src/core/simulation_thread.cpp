// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/simulation_thread.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>

#include "hooke/base/assert.h"

namespace hooke {

struct SimulationThread::Impl {
  enum class End { none, now, after_commands };
  static constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

  using Clock = std::chrono::steady_clock;
  static constexpr Clock::duration kMostDelay = std::chrono::milliseconds(50);  // that is made up for

  Simulation simulation;  // the thread's own, once it runs
  Stepper stepper;
  std::shared_ptr<const Snapshot> mailbox;

  mutable std::mutex mutex;  // guards the mailbox and all below
  std::condition_variable changed;
  std::deque<Command> commands;
  std::int64_t steps_left;  // beside the current one
  std::uint64_t orders = 0;  // to pause, resume or step, so far
  Clock::duration interval{};   // between two steps, at least
  Clock::time_point next_step;  // is due then
  bool busy;            // with a command, a step or a snapshot
  bool fresh = true;    // the mailbox holds the state as it is
  bool wanted = false;  // a reader wants a fresh one
  End end = End::none;
  std::optional<Error> failure;
  std::thread thread;

  Impl(Simulation started, bool paused, Stepper takes_steps)
      : simulation(std::move(started)),
        stepper(std::move(takes_steps)),
        mailbox(simulation.snapshot()),
        steps_left(paused ? 0 : kNoLimit),
        busy(!paused),
        thread([this] { work(); }) {}

  bool is_idle() const { return commands.empty() && steps_left == 0 && !(wanted && !fresh); }

  // Whether nothing is to be done before the next step is due.
  bool is_early() const {
    return commands.empty() && steps_left > 0 && !(wanted && !fresh) && Clock::now() < next_step;
  }

  void work() {
    std::unique_lock lock(mutex);
    for (;;) {
      busy = !is_idle();
      changed.wait(lock, [&] { return end != End::none || !is_idle(); });
      busy = true;
      if (is_early()) changed.wait_until(lock, next_step, [&] { return end != End::none || !is_early(); });
      if (end == End::now || (end == End::after_commands && commands.empty())) return;
      if (!commands.empty()) {
        carry_out(lock);
      } else if (steps_left > 0 && Clock::now() >= next_step) {
        take_step(lock);
      }
      // A state that no longer changes goes into the mailbox unasked.
      if (!fresh && commands.empty() && (wanted || steps_left == 0)) publish(lock);
    }
  }

  // Carries out the commands that have come so far, so that later commands don't make steps wait for ever.
  void carry_out(std::unique_lock<std::mutex>& lock) {
    for (std::size_t left = commands.size(); left > 0 && end != End::now; --left) {
      Command command = std::move(commands.front());
      commands.pop_front();
      fresh = false;
      lock.unlock();
      const std::optional<Error> thrown = error_of([&] { command(simulation); });
      command = nullptr;  // what it holds may call us back
      lock.lock();
      if (thrown) fail_with(*thrown);
    }
  }

  void take_step(std::unique_lock<std::mutex>& lock) {
    if (steps_left != kNoLimit) --steps_left;
    next_step = std::max(next_step + interval, Clock::now() - kMostDelay);
    fresh = false;
    const std::uint64_t orders_before = orders;
    lock.unlock();
    std::optional<Error> failed;
    const std::optional<Error> thrown = error_of([&] {
      if (auto taken = stepper ? stepper(simulation) : simulation.step(); !taken) failed = std::move(taken).error();
    });
    lock.lock();
    failure = thrown ? thrown : failed;
    if (failure && orders == orders_before) steps_left = 0;  // a later order may come with another state
  }

  void publish(std::unique_lock<std::mutex>& lock) {
    wanted = false;
    fresh = true;
    lock.unlock();
    std::shared_ptr<const Snapshot> now;
    const std::optional<Error> thrown = error_of([&] { now = simulation.snapshot(); });
    lock.lock();
    if (thrown) return fail_with(*thrown);
    mailbox.swap(now);
    lock.unlock();
    now.reset();  // may free much
    lock.lock();
  }

  void fail_with(const Error& error) {
    failure = error;
    steps_left = 0;
  }

  template <class Body>
  static std::optional<Error> error_of(const Body& body) {
    try {
      body();
      return {};
    } catch (const std::exception& thrown) {
      return Error{Error::Kind::run_failed, {{"simulation thread", thrown.what()}}};
    } catch (...) {
      return Error{Error::Kind::run_failed, {{"simulation thread", "a command has thrown what is no exception"}}};
    }
  }

  template <class Change>
  void change(const Change& what) {
    {
      const std::lock_guard lock(mutex);
      what();
    }
    changed.notify_all();
  }

  // Changes how many steps are left.
  template <class Left>
  void order(const Left& left) {
    change([&] {
      ++orders;
      steps_left = left(steps_left);
    });
  }

  void stop(End how) {
    change([&] { end = how; });
    if (thread.joinable()) thread.join();
  }
};

SimulationThread::SimulationThread(Simulation simulation, bool paused, Stepper stepper)
    : impl_(std::make_unique<Impl>(std::move(simulation), paused, std::move(stepper))) {}

SimulationThread::~SimulationThread() {
  if (impl_) impl_->stop(Impl::End::now);
}

void SimulationThread::post(Command command) {
  HOOKE_ASSERT(command != nullptr);
  impl_->change([&] { impl_->commands.push_back(std::move(command)); });
}

void SimulationThread::pause() {
  impl_->order([](std::int64_t) { return std::int64_t{0}; });
}

void SimulationThread::resume() {
  impl_->order([](std::int64_t) { return Impl::kNoLimit; });
}

void SimulationThread::step(std::int64_t count) {
  HOOKE_ASSERT(count > 0, count);
  impl_->order([count](std::int64_t left) { return left == Impl::kNoLimit ? count : left + count; });
}

void SimulationThread::set_pace(double steps_per_second) {
  HOOKE_ASSERT(steps_per_second > 0, steps_per_second);
  constexpr double kLongest = 3600;  // s
  const std::chrono::duration<double> seconds(std::min(1 / steps_per_second, kLongest));
  impl_->change([&] {
    impl_->interval = std::chrono::duration_cast<Impl::Clock::duration>(seconds);
    impl_->next_step = Impl::Clock::now();
  });
}

bool SimulationThread::is_paused() const {
  const std::lock_guard lock(impl_->mutex);
  return !impl_->busy && impl_->is_idle();
}

std::shared_ptr<const Snapshot> SimulationThread::latest() {
  std::shared_ptr<const Snapshot> now;
  impl_->change([&] {
    impl_->wanted = !impl_->fresh;
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
