// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// What a session does on the engine's thread, beside the actions: steps, and figures for the window.

#include <algorithm>
#include <utility>

#include "session.h"

namespace hooke::view {
namespace {

using namespace std::chrono_literals;

constexpr auto kRateInterval = 250ms;

}  // namespace

Expected<void> Session::take_step(Simulation& simulation) {
  auto taken = timeline_->step(simulation);
  {
    const std::lock_guard lock(mutex_);
    readings_.failure = taken ? std::string() : taken.error().text();
  }
  publish(simulation);
  if (taken && Clock::now() >= measure_from_) measure(simulation);
  return taken;
}

void Session::publish(const Simulation& simulation) {
  const auto now = Clock::now();
  const std::lock_guard lock(mutex_);
  ++readings_.version;
  led_ = timeline_->hand().led();
  readings_.steps = timeline_->steps();
  readings_.step_count = simulation.step_count();
  readings_.time = simulation.time();
  readings_.time_step = simulation.scene().time_step;
  readings_.particles = simulation.particle_count();
  readings_.reach = timeline_->reach();
  readings_.held_collider = timeline_->hand().held_collider();
  readings_.held_particles = timeline_->hand().held_particles().size();
  readings_.replay = timeline_->replay();
  readings_.recorded = timeline_->is_recorded();
  if (const std::chrono::duration<double> since = now - rate_from_; since > kRateInterval) {
    const auto steps = static_cast<double>(readings_.steps - rate_steps_);
    const StageTimes spent = simulation.stage_times() - rate_stages_;
    readings_.steps_per_second = std::max(0.0, steps) / since.count();
    if (steps > 0 && spent.total() >= 0) {
      const double each = 1 / steps;
      readings_.stages = {each * spent.sort, each * spent.list, each * spent.motion, each * spent.force,
                          each * spent.drift};
      readings_.step_seconds = spent.total() / steps;
    }
    rate_from_ = now;
    rate_steps_ = readings_.steps;
    rate_stages_ = simulation.stage_times();
  }
  if (text_ != timeline_->scene() || !scene_) {
    text_ = timeline_->scene();
    scene_ = std::make_shared<const Scene>(simulation.scene());
    ++scene_version_;
    if (thread_) apply_pace();
  }
}

void Session::measure(const Simulation& simulation) {
  constexpr int kShare = 20;  // measured in at most one part in so many of the time
  const auto begin = Clock::now();
  auto now = simulation.measure();
  if (!now) return;
  auto figures = std::make_shared<Figures>();
  *figures = {timeline_->steps(),  simulation.time(),           std::move(*now),
              simulation.ledger(), simulation.initial_energy(), simulation.initial_elastic()};
  const auto end = Clock::now();
  measure_from_ = end + std::max<Clock::duration>(kShare * (end - begin), 100ms);
  const std::lock_guard lock(mutex_);
  figures_ = std::move(figures);
}

void Session::look_closely(const Simulation& simulation) {
  const std::optional<std::uint64_t> id = [&] {
    const std::lock_guard lock(mutex_);
    return inspected_;
  }();
  if (!id || (id == looked_at_ && Clock::now() < look_from_)) return;
  const auto begin = Clock::now();
  auto found = inspect_particle(simulation, *id);
  const auto end = Clock::now();
  look_from_ = end + 10 * (end - begin);
  looked_at_ = id;
  const std::lock_guard lock(mutex_);
  inspection_ = std::move(found);
}

void Session::start_column(const Simulation& simulation, Coloring by) {
  if (next_column_.valid()) {
    if (next_column_.wait_for(0s) != std::future_status::ready) return;
    auto column = std::make_shared<const ColorColumn>(next_column_.get());
    const std::lock_guard lock(mutex_);
    column_ = std::move(column);
    ++readings_.version;
  }
  // The scene and the snapshot never change: the engine steps on meanwhile.
  next_column_ = std::async(std::launch::async, [scene = simulation.scene(), now = simulation.snapshot(),
                                                 broken = simulation.broken_springs(),
                                                 by] { return contact_column(scene, *now, broken, by); });
}

}  // namespace hooke::view
