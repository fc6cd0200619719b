// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "timeline.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "particle_changes.h"

namespace hooke::view {
namespace {

constexpr std::size_t kMostMoments = 2000;
constexpr int kKeepShare = 20;  // states are kept in at most one part in so many of the time

std::size_t bytes_of(const SimulationState& state) {
  const ParticleSet& p = state.particles;
  return p.size() * (sizeof p.id[0] + sizeof p.material[0] + 2 * sizeof p.position[0]) +
         p.acceleration.size() * sizeof(Vec3d) + state.broken_springs.size() * sizeof(std::uint64_t);
}

// A hash is read from all particles: in large scenes it is written more seldom.
std::int64_t hash_interval(std::uint64_t particles) { return particles < 100'000 ? 10 : 50; }

}  // namespace

Timeline::Timeline(Settings settings, const Simulation& initial)
    : document_(std::move(settings.source), std::move(settings.scene)),
      recorder_(std::move(settings.recorder)),
      script_(std::make_move_iterator(settings.replay.begin()), std::make_move_iterator(settings.replay.end())),
      memory_(settings.memory),
      hash_interval_(hash_interval(initial.particle_count())) {
  start_again(initial);
  replay_report_.running = !script_.empty();
  mark(initial);
  keep(initial);
}

void Timeline::mark(const Simulation& simulation) {
  if (recorder_) recorder_->add_hash(steps_, simulation.state_hash());
}

Expected<void> Timeline::step(Simulation& simulation) {
  if (auto replayed = replay_here(simulation); !replayed) return replayed;
  if (auto taken = take_step(simulation); !taken) return taken;
  if (steps_ % hash_interval_ == 0) mark(simulation);
  if (Clock::now() >= keep_from_) keep(simulation);
  return replay_here(simulation);
}

Expected<void> Timeline::take_step(Simulation& simulation) {
  if (auto led = hand_.before_step(simulation); !led) return led;
  if (auto taken = simulation.step(); !taken) return taken;
  ++steps_;
  note_births(simulation);
  return {};
}

void Timeline::note_births(const Simulation& simulation) {
  if (simulation.next_id() == next_id_) return;
  births_->push_back({next_id_, simulation.time()});
  next_id_ = simulation.next_id();
}

void Timeline::start_again(const Simulation& simulation) {
  hand_ = Hand{};
  next_id_ = simulation.next_id();
  births_ = std::make_shared<std::vector<Birth>>(1, Birth{1, simulation.time()});
}

// Carries out the entries of a replay for the present number of steps.
Expected<void> Timeline::replay_here(Simulation& simulation) {
  while (!script_.empty() && script_.front().steps <= steps_) {
    const RecordEntry entry = std::move(script_.front());
    script_.pop_front();
    if (const auto* action = std::get_if<Action>(&entry.what)) {
      if (auto performed = perform(simulation, *action); !performed) return performed;
      continue;
    }
    ++replay_report_.compared;
    if (simulation.state_hash() == std::get<std::uint64_t>(entry.what)) {
      if (!replay_report_.diverged) replay_report_.last_equal = steps_;
    } else if (!replay_report_.diverged) {
      replay_report_.diverged = steps_;
    }
  }
  replay_report_.running = !script_.empty();
  return {};
}

Expected<void> Timeline::act(Simulation& simulation, const Action& action) {
  script_.clear();
  replay_report_.running = false;
  return perform(simulation, action);
}

Expected<void> Timeline::perform(Simulation& simulation, const Action& action) {
  struct Performer {
    Timeline& line;
    Simulation& s;
    Expected<void> operator()(const AddBall& a) const { return add_ball(s, a); }
    Expected<void> operator()(const HoldCollider& a) const { return line.hand_.hold(s, a); }
    Expected<void> operator()(const HoldParticles& a) const { return line.hand_.hold(s, a); }
    Expected<void> operator()(const Lead& a) const {
      line.hand_.lead(a);
      return {};
    }
    Expected<void> operator()(const LetGo&) const { return line.hand_.let_go(s); }
    Expected<void> operator()(const CutSprings& a) const { return s.cut_springs(a.springs); }
    Expected<void> operator()(const Scatter& a) const { return scatter(s, a); }
    Expected<void> operator()(const Reset&) const {
      auto reset = line.document_.reset(s);
      if (reset) line.start_again(s);
      return reset;
    }
    Expected<void> operator()(const LoadCheckpoint& a) const {
      auto loaded = line.document_.load_checkpoint(s, a.file);
      if (loaded) line.start_again(s);
      return loaded;
    }
    Expected<void> operator()(const ChangeScene& a) const { return line.document_.change(s, a.patch, line.hand_); }
  };
  if (auto performed = std::visit(Performer{*this, simulation}, action); !performed) return performed;
  note_births(simulation);
  done_.push_back({steps_, action});
  if (recorder_) recorder_->add(steps_, action);
  return {};
}

void Timeline::keep(const Simulation& simulation) {
  const auto begin = Clock::now();
  Moment moment{steps_, done_.size(), births_, births_->size(), simulation.state(), document_.json(), hand_};
  recent_bytes_ += bytes_of(moment.state);
  recent_.push_back(std::move(moment));
  while (recent_.size() > 1 && (recent_bytes_ > memory_ || recent_.size() > kMostMoments)) {
    recent_bytes_ -= bytes_of(recent_.front().state);
    recent_.pop_front();
  }
  const auto end = Clock::now();
  keep_from_ = end + kKeepShare * (end - begin);
}

Expected<void> Timeline::restore(Simulation& simulation, const Moment& moment) {
  if (auto restored = document_.go_back(simulation, moment.state, moment.scene, moment.hand); !restored)
    return restored;
  hand_ = moment.hand;
  steps_ = moment.steps;
  births_ = moment.births;
  births_->resize(moment.birth_count);
  next_id_ = simulation.next_id();
  return {};
}

Expected<void> Timeline::go_back(Simulation& simulation, std::int64_t steps) {
  const std::int64_t target = std::max(steps_ - steps, recent_.front().steps);
  script_.clear();
  replay_report_.running = false;
  const auto after = std::find_if(recent_.begin(), recent_.end(), [&](const Moment& m) { return m.steps > target; });
  for (auto m = after; m != recent_.end(); ++m) recent_bytes_ -= bytes_of(m->state);
  recent_.erase(after, recent_.end());
  const std::size_t actions = recent_.back().actions;
  if (auto restored = restore(simulation, recent_.back()); !restored) return restored;

  // From there to the target again, with the actions of the time.
  std::vector<Done> again(std::make_move_iterator(done_.begin() + static_cast<std::ptrdiff_t>(actions)),
                          std::make_move_iterator(done_.end()));
  done_.resize(actions, Done{});
  std::optional<RecordWriter> recorder = std::exchange(recorder_, {});
  Expected<void> gone{};
  for (auto next = again.begin(); gone; ++next) {
    const std::int64_t until = next == again.end() ? target : std::min(target, next->steps);
    while (gone && steps_ < until) gone = take_step(simulation);
    if (next == again.end() || next->steps > target) break;
    if (gone) gone = perform(simulation, next->action);
  }
  recorder_ = std::move(recorder);
  if (recorder_) recorder_->go_back(steps_, done_.size());
  return gone;
}

}  // namespace hooke::view
