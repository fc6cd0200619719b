// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "action.h"
#include "hand.h"
#include "hooke/base/expected.h"
#include "hooke/core/simulation.h"
#include "record.h"
#include "scene_document.h"

namespace hooke::view {

/// How a replay goes.
struct ReplayReport {
  bool running = false;          ///< entries are left
  std::int64_t last_equal = 0;   ///< steps after which the hash was last found right
  std::int64_t compared = 0;     ///< hashes so far
  std::optional<std::int64_t> diverged;  ///< steps after which a hash was wrong
};

/// What happens to a simulation, in its order: steps and actions. Records them, replays them, and goes back to a state
/// of some steps ago. All functions but the constructor are called where the simulation is stepped.
class Timeline {
 public:
  struct Settings {
    SceneSource source;
    scene::Json scene;                            ///< resolved
    std::optional<RecordWriter> recorder;  ///< none: not recorded
    std::vector<RecordEntry> replay;       ///< empty: none
    std::size_t memory = std::size_t{512} << 20;  ///< that recent states may take, bytes
  };
  /// `initial` is the simulation that will be stepped.
  Timeline(Settings settings, const Simulation& initial);

  /// Carries out what a replay has before the first step.
  Expected<void> begin(Simulation& simulation) { return replay_here(simulation); }
  /// Takes a step, and before it the actions that a replay has for it.
  Expected<void> step(Simulation& simulation);
  /// Ends a replay that is running. Where it fails, nothing has changed.
  Expected<void> act(Simulation& simulation, const Action& action);
  /// Goes back so many steps (> 0), or as many as the recent states reach. What was done in them is undone. Also goes
  /// back from a failed step.
  Expected<void> go_back(Simulation& simulation, std::int64_t steps);
  /// Writes the hash of the present state into the record.
  void mark(const Simulation& simulation);

  /// Steps since the start, without those that were taken back. Not the simulation's own count: that follows the clock
  /// when the time step is changed.
  std::int64_t steps() const { return steps_; }
  /// How many steps the recent states reach back.
  std::int64_t reach() const { return recent_.empty() ? 0 : steps_ - recent_.front().steps; }
  const std::shared_ptr<const scene::Json>& scene() const { return document_.json(); }
  const Hand& hand() const { return hand_; }
  const ReplayReport& replay() const { return replay_report_; }
  bool is_recorded() const { return recorder_ && recorder_->is_good(); }

  /// From which id on particles were born when: ascending.
  struct Birth {
    std::uint64_t first_id = 1;
    double time = 0;  ///< s
  };
  const std::vector<Birth>& births() const { return *births_; }

 private:
  struct Moment {
    std::int64_t steps = 0;
    std::size_t actions = 0;  // that had been before
    std::shared_ptr<std::vector<Birth>> births;
    std::size_t birth_count = 0;  // of these, so far
    SimulationState state;
    std::shared_ptr<const scene::Json> scene;
    Hand hand;
  };
  struct Done {
    std::int64_t steps = 0;
    Action action;
  };
  using Clock = std::chrono::steady_clock;

  Expected<void> perform(Simulation& simulation, const Action& action);
  Expected<void> take_step(Simulation& simulation);
  Expected<void> replay_here(Simulation& simulation);
  Expected<void> restore(Simulation& simulation, const Moment& moment);
  void note_births(const Simulation& simulation);
  void start_again(const Simulation& simulation);
  void keep(const Simulation& simulation);

  SceneDocument document_;
  std::optional<RecordWriter> recorder_;
  std::deque<RecordEntry> script_;
  ReplayReport replay_report_;
  std::size_t memory_;
  Hand hand_;
  std::int64_t steps_ = 0, hash_interval_;
  std::vector<Done> done_;
  std::shared_ptr<std::vector<Birth>> births_;  // since the start or the last reset
  std::uint64_t next_id_;
  std::deque<Moment> recent_;
  std::size_t recent_bytes_ = 0;
  Clock::time_point keep_from_{};  // no state is kept before
};

}  // namespace hooke::view
