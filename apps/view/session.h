// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "arguments.h"
#include "hooke/core/simulation_thread.h"
#include "inspection.h"
#include "record.h"
#include "timeline.h"
#include "view_frame.h"

namespace hooke::view {

/// Figures that take a pass over all particles: found now and then.
struct Figures {
  std::int64_t steps = 0;  ///< of the timeline
  double time = 0;         ///< s
  Measurements now;
  Ledger ledger;
  double initial_energy = 0;  ///< J
  double initial_elastic = 0;  ///< J
};

/// What the window shows in numbers; cheap, so that it is renewed after every step.
struct Readings {
  std::int64_t steps = 0;       ///< of the timeline
  std::int64_t step_count = 0;  ///< of the simulation
  double time = 0;              ///< s
  double time_step = 0;         ///< s
  std::uint64_t particles = 0;
  double steps_per_second = 0;  ///< of wall time, of late
  StageTimes stages;            ///< of the last steps, s a step
  double step_seconds = 0;      ///< of the last steps, s
  std::int64_t reach = 0;       ///< how many steps can be taken back
  std::string held_collider;
  std::size_t held_particles = 0;
  ReplayReport replay;
  bool recorded = false;
  std::string failure;        ///< why the last step failed; empty while all is well
  std::uint64_t version = 0;  ///< goes up with every step and every action
};

/// How a session is opened.
struct SessionOptions {
  run::SceneArguments scene;
  run::DeviceArguments device;
  std::filesystem::path resume;  ///< a checkpoint, or empty
  std::filesystem::path record;  ///< empty: none
  std::vector<RecordEntry> replay;
  bool paused = false;
};

/// A simulation that is stepped on its own thread and used from a window: no function waits for a step, but where the
/// comment says so. Belongs to the window's thread.
class Session {
 public:
  static Expected<std::unique_ptr<Session>> open(const SessionOptions& options);
  ~Session();

  // Time ------------------------------------------------------------------------------------------------------------
  void run(bool on);
  bool runs() const { return runs_; }
  /// Whether nothing runs and nothing waits.
  bool is_idle() const { return thread_->is_paused(); }
  void step(std::int64_t count = 1);
  void go_back(std::int64_t steps);
  /// Simulated seconds a second, > 0; infinite: as fast as possible.
  void set_speed(double speed);
  double speed() const { return speed_; }

  // Actions ---------------------------------------------------------------------------------------------------------
  /// Queues an action; what it complains about comes with next_message(), unless `quiet`.
  void act(Action action, bool quiet = false);
  /// The text of the scene with all changes that were asked for.
  std::shared_ptr<const scene::Json> wanted();
  /// Changes the scene so that its text becomes `wanted_text`; may be undone. `continues`: undone with the change
  /// before.
  void change_scene(const scene::Json& wanted_text, bool continues = false);
  /// Whether all changes that were asked for have taken effect.
  bool is_text_settled() const;
  void undo();
  void redo();
  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }
  void save_checkpoint(const std::filesystem::path& file);

  // What there is ---------------------------------------------------------------------------------------------------
  /// The latest frame; null before the first. Asks for the next one, if the last has come.
  std::shared_ptr<const ViewFrame> frame(const ColorRequest& color);
  /// The scene's text as it is now, with its colliders where a hand has led them.
  scene::Json text_to_save();
  /// A recent state; when the engine is idle, the present one.
  std::shared_ptr<const Snapshot> snapshot() { return thread_->latest(); }
  Readings readings() const;
  std::shared_ptr<const Figures> figures() const;
  /// The scene as it is simulated now; changes are in it when they have taken effect.
  std::shared_ptr<const Scene> scene() const;
  /// Goes up when the scene has changed.
  std::uint64_t scene_version() const;
  /// What an action has complained about, or said; empty where there is nothing new.
  std::string next_message();

  void inspect(std::optional<std::uint64_t> id);
  std::optional<Inspection> inspection() const;

  const Vec3d& origin() const { return origin_; }
  const ParticleSet& first_particles() const { return first_; }
  const SessionOptions& options() const { return options_; }
  std::string device() const { return device_; }
  const std::vector<Finding>& warnings() const { return warnings_; }

  /// Waits until everything asked for so far has been done and the engine is paused. For tests and for the end.
  void wait();
  /// Ends the record with the hash of the last state, which it returns. Waits.
  std::uint64_t finish();

 private:
  Session() = default;
  /// `changes_text`: whether it may change the scene's text.
  void post(std::function<Expected<void>(Simulation&)> what, bool changes_text = false);
  Expected<void> take_step(Simulation& simulation);
  void publish(const Simulation& simulation);
  void measure(const Simulation& simulation);
  void look_closely(const Simulation& simulation);
  void start_column(const Simulation& simulation, Coloring by);
  void say(const std::string& message);
  void apply_pace();

  SessionOptions options_;
  std::string device_;
  std::vector<Finding> warnings_;
  ParticleSet first_;
  Vec3d origin_{0, 0, 0};
  bool runs_ = false;
  std::atomic<double> speed_{1};
  std::shared_ptr<const scene::Json> wanted_;  // the text with all wanted changes
  std::vector<std::shared_ptr<const scene::Json>> undo_, redo_;
  std::unique_ptr<Timeline> timeline_;  // the engine's

  mutable std::mutex mutex_;  // guards all down to the thread
  Readings readings_;
  std::shared_ptr<const Figures> figures_;
  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const scene::Json> text_;
  std::uint64_t scene_version_ = 0;
  int text_changes_ = 0;  // that wait
  std::vector<Hand::Led> led_;
  std::vector<std::string> messages_;
  std::shared_ptr<ViewFrame> ready_;
  std::vector<std::shared_ptr<ViewFrame>> frames_;
  bool frame_wanted_ = false;
  std::uint64_t ready_version_ = 0;  // of the readings
  ColorRequest ready_color_;
  std::optional<std::uint64_t> inspected_;
  std::optional<Inspection> inspection_;
  std::shared_ptr<const ColorColumn> column_;

  // The engine's own.
  using Clock = std::chrono::steady_clock;
  Clock::time_point rate_from_{}, measure_from_{}, look_from_{};
  std::int64_t rate_steps_ = 0;
  double rate_time_ = 0;
  StageTimes rate_stages_;
  std::future<ColorColumn> next_column_;
  std::optional<std::uint64_t> looked_at_;

  std::unique_ptr<SimulationThread> thread_;  // last: it uses all above
};

}  // namespace hooke::view
