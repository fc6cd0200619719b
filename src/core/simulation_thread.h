// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "hooke/base/expected.h"
#include "hooke/core/simulation.h"
#include "hooke/core/snapshot.h"

namespace hooke {

/// Steps a simulation on a thread of its own, as fast as it goes, for a window or another reader: neither waits for the
/// other. Commands are carried out between steps, in the order in which they came; the latest state
/// lies in a mailbox. No lock is pinned across a step or a command. Any thread may call any member but finish() and the
/// destructor, which are the last call.
///
///     hooke::SimulationThread thread(std::move(simulation));
///     while (window.is_open()) {
///       if (hand.pulls()) thread.post([=](hooke::Simulation& s) { (void)s.apply_impulse(id, pull); });
///       draw(thread.latest()->particles);
///     }
class SimulationThread {
 public:
  /// An action on the simulation between two steps. What it throws is a failure().
  using Command = std::function<void(Simulation&)>;

  /// Takes one step of the simulation, with what is to be done before and after each step.
  using Stepper = std::function<Expected<void>(Simulation&)>;

  /// `stepper` replaces Simulation::step(); it is called on the thread.
  explicit SimulationThread(Simulation simulation, bool paused = false, Stepper stepper = {});
  /// Ends after the current step or command; waiting commands are not carried out.
  ~SimulationThread();
  SimulationThread(const SimulationThread&) = delete;
  SimulationThread& operator=(const SimulationThread&) = delete;

  /// Queues a command: an edit, another material or motion, a restore. Returns at once.
  void post(Command command);

  /// The same with an answer, which is ready when the command has been carried out; get() throws what the command
  /// throws, or std::future_error where the thread ends before. A command that waits for the answer of another command
  /// waits for ever.
  template <class Ask, class Answer = std::invoke_result_t<Ask, Simulation&>>
  std::future<Answer> ask(Ask command) {
    auto task = std::make_shared<std::packaged_task<Answer(Simulation&)>>(std::move(command));
    std::future<Answer> answer = task->get_future();
    post([task](Simulation& s) { (*task)(s); });
    return answer;
  }

  /// Pauses after the current step.
  void pause();
  /// Goes on until told otherwise.
  void resume();
  /// Takes so many steps (> 0), beside those that earlier calls have asked for, then pauses.
  void step(std::int64_t count = 1);
  /// From now on takes at most so many steps (> 0, infinite: no limit, as at the start) a second of wall time. Steps
  /// that are late by more than 50 ms are not made up for.
  void set_pace(double steps_per_second);
  /// Whether nothing runs and nothing waits: latest() is the present state.
  bool is_paused() const;

  /// The latest state that was put into the mailbox, never null. Requests a newer one, if there is one, after the
  /// current step: while steps go on, a state is only made on request.
  std::shared_ptr<const Snapshot> latest();

  /// The error of the last step or command. The thread pauses where one fails; a state that a command restores can
  /// go on.
  std::optional<Error> failure() const;

  /// Ends the thread after the current step and the waiting commands. Steps that have not been taken are dropped.
  /// Returns the simulation.
  Simulation finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hooke
