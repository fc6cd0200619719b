// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "session.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <system_error>
#include <thread>
#include <utility>

#include "hooke/io/checkpoint.h"
#include "hooke/run/open_simulation.h"

namespace hooke::view {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kFrames = 3;  // one is shown, one is ready, one is filled
constexpr std::size_t kMostUndo = 200;

}  // namespace

Expected<std::unique_ptr<Session>> Session::open(const SessionOptions& options) {
  auto opened = run::open_simulation(options.scene, options.device, {});
  if (!opened) return fail(std::move(opened).error());
  std::unique_ptr<Session> session(new Session);
  Session& s = *session;
  s.options_ = options;
  s.warnings_ = std::move(opened->warnings);
  Simulation& simulation = opened->simulation;
  const BackendInfo info = simulation.backend_info();
  s.device_ = info.device + (info.isa.empty() ? "" : " " + info.isa) + ", " + std::to_string(info.threads) +
              (info.threads == 1 ? " thread" : " threads");
  s.first_ = simulation.particles();
  const Domain& domain = simulation.scene().domain;
  s.origin_ = 0.5 * (domain.min + domain.max);

  Timeline::Settings settings;
  run::DeviceArguments device = options.device;  // what "auto" has taken is kept
  if (device.device == "auto")
    device.device = opened->simulation.backend_info().device.starts_with("cuda") ? "cuda" : "cpu";
  settings.source = scene_source(options.scene, device);
  settings.scene = scene::Json::parse(opened->resolved);
  settings.replay = options.replay;
  if (!options.record.empty()) {
    auto recorder = RecordWriter::create(options.record, {options.scene.file, options.scene.overrides,
                                                          options.scene.allow_outside, options.device.device});
    if (!recorder) return fail(std::move(recorder).error());
    settings.recorder = std::move(*recorder);
  }
  s.timeline_ = std::make_unique<Timeline>(std::move(settings), simulation);
  if (auto begun = s.timeline_->begin(simulation); !begun) return fail(std::move(begun).error());
  if (!options.resume.empty()) {
    std::error_code ignored;
    const LoadCheckpoint load{std::filesystem::absolute(options.resume, ignored).string()};
    if (auto loaded = s.timeline_->act(simulation, load); !loaded) return fail(std::move(loaded).error());
  }
  s.wanted_ = s.timeline_->scene();
  s.publish(simulation);
  s.measure(simulation);
  s.thread_ =
      std::make_unique<SimulationThread>(std::move(simulation), true, [&s](Simulation& of) { return s.take_step(of); });
  s.set_speed(1);
  s.run(!options.paused);
  return session;
}

Session::~Session() { thread_.reset(); }

// On the window's thread ----------------------------------------------------------------------------------------------

void Session::say(const std::string& message) {
  const std::lock_guard lock(mutex_);
  messages_.push_back(message);
}

void Session::post(std::function<Expected<void>(Simulation&)> what, bool changes_text) {
  if (changes_text) {
    const std::lock_guard lock(mutex_);
    ++text_changes_;
  }
  thread_->post([this, what = std::move(what), changes_text](Simulation& simulation) {
    const bool failed_before = !readings_.failure.empty();
    const auto done = what(simulation);
    publish(simulation);
    const std::lock_guard lock(mutex_);
    if (!done) messages_.push_back(done.error().text());
    // A simulation that was restored or rebuilt can go on.
    if (done && failed_before && changes_text) readings_.failure.clear();
    if (changes_text) --text_changes_;
  });
}

void Session::run(bool on) {
  runs_ = on;
  on ? thread_->resume() : thread_->pause();
}

void Session::step(std::int64_t count) {
  runs_ = false;
  thread_->pause();
  thread_->step(count);
}

void Session::go_back(std::int64_t steps) {
  run(false);
  undo_.clear();
  redo_.clear();
  post(
      [this, steps](Simulation& s) {
        auto gone = timeline_->go_back(s, steps);
        if (gone) measure(s);
        return gone;
      },
      true);
}

void Session::set_speed(double speed) {
  const std::lock_guard lock(mutex_);
  speed_ = speed;
  apply_pace();
}

// With the mutex locked.
void Session::apply_pace() {
  const double dt = scene_->time_step;
  thread_->set_pace(std::isfinite(speed_) ? speed_ / dt : std::numeric_limits<double>::infinity());
}

void Session::act(Action action, bool quiet) {
  const bool changes_text = std::holds_alternative<ChangeScene>(action) || std::holds_alternative<Reset>(action) ||
                            std::holds_alternative<LoadCheckpoint>(action);
  post(
      [this, action = std::move(action), quiet](Simulation& s) -> Expected<void> {
        auto done = timeline_->act(s, action);
        if (done && Clock::now() >= measure_from_) measure(s);
        if (!done && quiet) return {};
        return done;
      },
      changes_text);
}

std::shared_ptr<const scene::Json> Session::wanted() {
  const std::lock_guard lock(mutex_);
  if (text_changes_ == 0) wanted_ = text_;
  return wanted_;
}

bool Session::is_text_settled() const {
  const std::lock_guard lock(mutex_);
  return text_changes_ == 0;
}

void Session::change_scene(const scene::Json& wanted_text, bool continues) {
  const std::shared_ptr<const scene::Json> before = wanted();
  const scene::Json patch = scene::Json::diff(*before, wanted_text);
  if (patch.empty()) return;
  if (!continues || undo_.empty()) undo_.push_back(before);
  if (undo_.size() > kMostUndo) undo_.erase(undo_.begin());
  redo_.clear();
  wanted_ = std::make_shared<const scene::Json>(wanted_text);
  act(ChangeScene{patch});
}

void Session::undo() {
  if (undo_.empty()) return;
  const std::shared_ptr<const scene::Json> before = wanted();
  const scene::Json patch = scene::Json::diff(*before, *undo_.back());
  redo_.push_back(before);
  wanted_ = undo_.back();
  undo_.pop_back();
  act(ChangeScene{patch});
}

void Session::redo() {
  if (redo_.empty()) return;
  const std::shared_ptr<const scene::Json> before = wanted();
  const scene::Json patch = scene::Json::diff(*before, *redo_.back());
  undo_.push_back(before);
  wanted_ = redo_.back();
  redo_.pop_back();
  act(ChangeScene{patch});
}

void Session::save_checkpoint(const std::filesystem::path& file) {
  post([this, file](Simulation& s) -> Expected<void> {
    auto written = io::write_checkpoint(file, s.state(), io::describe_run(s.scene(), s.backend_info().precision));
    if (written) say("saved " + file.string());
    return written;
  });
}

std::shared_ptr<const ViewFrame> Session::frame(const ColorRequest& color) {
  const std::lock_guard lock(mutex_);
  ColorRequest request = color;
  request.column = column_;
  if (frame_wanted_ || (ready_ && ready_version_ == readings_.version && ready_color_ == request)) return ready_;
  frame_wanted_ = true;
  // The thread locks nothing of ours while it carries out commands, so this can't wait for it.
  thread_->post([this, request](Simulation& simulation) {
    std::shared_ptr<ViewFrame> next;
    std::uint64_t version = 0;
    {
      const std::lock_guard guard(mutex_);
      version = readings_.version;
      for (const std::shared_ptr<ViewFrame>& frame : frames_) {
        if (frame.use_count() == 1) next = frame;
      }
      if (!next) frames_.push_back(next = std::make_shared<ViewFrame>());
    }
    if (request.by == Coloring::pressure || request.by == Coloring::contacts) start_column(simulation, request.by);
    auto filled = fill_frame(simulation, *timeline_, request, origin_, *next);
    if (!filled) say(filled.error().text());
    look_closely(simulation);
    const std::lock_guard guard(mutex_);
    ready_ = std::move(next);
    ready_version_ = version;
    ready_color_ = request;
    frame_wanted_ = false;
  });
  return ready_;
}

Readings Session::readings() const {
  const std::lock_guard lock(mutex_);
  return readings_;
}
std::shared_ptr<const Figures> Session::figures() const {
  const std::lock_guard lock(mutex_);
  return figures_;
}
std::shared_ptr<const Scene> Session::scene() const {
  const std::lock_guard lock(mutex_);
  return scene_;
}
scene::Json Session::text_to_save() {
  const std::lock_guard lock(mutex_);
  return with_led_colliders(*text_, led_);
}
std::uint64_t Session::scene_version() const {
  const std::lock_guard lock(mutex_);
  return scene_version_;
}
std::optional<Inspection> Session::inspection() const {
  const std::lock_guard lock(mutex_);
  return inspection_;
}

void Session::inspect(std::optional<std::uint64_t> id) {
  const std::lock_guard lock(mutex_);
  inspected_ = id;
  inspection_.reset();
  ++readings_.version;
}

std::string Session::next_message() {
  const std::lock_guard lock(mutex_);
  if (messages_.empty()) return {};
  std::string message = std::move(messages_.front());
  messages_.erase(messages_.begin());
  return message;
}

void Session::wait() {
  while (!thread_->is_paused()) std::this_thread::sleep_for(1ms);
}

std::uint64_t Session::finish() {
  run(false);
  return thread_
      ->ask([this](Simulation& s) {
        timeline_->mark(s);
        return s.state_hash();
      })
      .get();
}

}  // namespace hooke::view
