// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/rank_balance.h"

#include <algorithm>
#include <cmath>

namespace hooke {
namespace {

constexpr double kMostUneven = 1.05;    // beyond what the last cut has reached
constexpr double kFew = 64;             // units of work that don't matter
constexpr double kRecentSteps = 100;    // after which a step counts 1/e
constexpr double kKnownAfter = 50;      // steps: now and then one is interrupted
constexpr double kTrustAfterCut = 50;   // steps that an expectation counts as
constexpr double kMostSlowness = 4;     // beyond that, something else has kept the rank busy

}  // namespace

void RankBalance::Interval::add(const Interval& other) {
  seconds.add(other.seconds);
  particles.add(other.particles);
  recent_seconds += other.recent_seconds;
  recent_work += other.recent_work;
  cut_seconds += other.cut_seconds;
}

RankBalance::Interval RankBalance::interval(std::uint64_t particles) {
  const auto steps = static_cast<double>(steps_);
  const double kept = std::exp(-steps / kRecentSteps);
  recent_steps_ = recent_steps_ * kept + steps;
  recent_seconds_ = recent_seconds_ * kept + seconds_;
  recent_work_ = recent_work_ * kept + work_;
  const Interval here{Spread::of(seconds_), Spread::of(static_cast<double>(particles)), recent_seconds_, recent_work_,
                      cut_seconds_};
  interval_steps_ = steps_;
  steps_ = 0;
  seconds_ = work_ = 0;
  return here;
}

void RankBalance::end_interval(const Interval& all) {
  mean_cut_seconds_ = all.cut_seconds / ranks_;
  mean_cost_ = all.recent_work > 0 ? all.recent_seconds / all.recent_work : 0;
  slowness_ = 1;
  if (recent_steps_ < kKnownAfter || !(mean_cost_ > 0)) return;
  // A little work tells little.
  const double few = kFew * recent_steps_;
  const double cost = (recent_seconds_ + few * mean_cost_) / (recent_work_ + few);
  slowness_ = std::clamp(cost / mean_cost_, 1 / kMostSlowness, kMostSlowness);
}

// A cut pays when what has been lost since the last one is what one costs.
bool RankBalance::wants_cut(const Spread& loads) {
  const double beyond = loads.most - (loads.sum / ranks_ + kFew) * reached_;
  lost_ += std::max(0.0, beyond) * mean_cost_ * static_cast<double>(interval_steps_);
  return loads.uneven(ranks_, kFew) > kMostUneven * reached_ && lost_ >= mean_cut_seconds_;
}

void RankBalance::begin_anew(const Spread& loads, double slowness, double work, double seconds) {
  reached_ = std::max(1.0, loads.uneven(ranks_, kFew));
  slowness_ = slowness;
  recent_steps_ = std::min(recent_steps_, kTrustAfterCut);
  recent_work_ = work * recent_steps_;
  recent_seconds_ = slowness * mean_cost_ * recent_work_;
  cut_seconds_ = seconds;
  lost_ = 0;
}

}  // namespace hooke
