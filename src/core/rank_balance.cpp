// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/rank_balance.h"

#include <algorithm>

namespace hooke {
namespace {

constexpr double kMostUneven = 1.05;  // beyond what the last cut has reached
constexpr double kFew = 64;           // units of work that don't matter
constexpr std::int64_t kWindow = 50;  // steps
constexpr double kMostSlowness = 4;   // beyond that, something else has kept the rank busy

}  // namespace

void RankBalance::Interval::add(const Interval& other) {
  seconds.add(other.seconds);
  particles.add(other.particles);
  least_seconds += other.least_seconds;
  work += other.work;
  cut_seconds += other.cut_seconds;
}

void RankBalance::add_step(double seconds, double work) {
  ++steps_;
  seconds_ += seconds;
  if (work > 0) least_cost_ = std::min(least_cost_, seconds / work);
  if (++steps_in_window_ < kWindow) return;
  last_least_cost_ = least_cost_;
  least_cost_ = kUnknown;
  steps_in_window_ = 0;
  is_known_ = true;
}

RankBalance::Interval RankBalance::interval(std::uint64_t particles) {
  const auto work = static_cast<double>(particles);
  Interval here{Spread::of(seconds_), Spread::of(work), 0, 0, cut_seconds_};
  cost_ = std::min(least_cost_, last_least_cost_);
  work_ = work;
  if (cost_ < kUnknown) {
    here.least_seconds = cost_ * work;
    here.work = work;
  }
  interval_steps_ = steps_;
  steps_ = 0;
  seconds_ = 0;
  return here;
}

void RankBalance::end_interval(const Interval& all) {
  mean_cut_seconds_ = all.cut_seconds / ranks_;
  mean_cost_ = all.work > 0 ? all.least_seconds / all.work : 0;
  slowness_ = 1;
  if (!is_known_ || !(mean_cost_ > 0) || !(cost_ < kUnknown)) return;
  // A little work tells little.
  const double cost = (cost_ * work_ + mean_cost_ * kFew) / (work_ + kFew);
  slowness_ = std::clamp(cost / mean_cost_, 1 / kMostSlowness, kMostSlowness);
}

// A cut pays when what has been lost since the last one is what one costs.
bool RankBalance::wants_cut(const Spread& loads) {
  const double beyond = loads.most - (loads.sum / ranks_ + kFew) * reached_;
  lost_ += std::max(0.0, beyond) * mean_cost_ * static_cast<double>(interval_steps_);
  return loads.uneven(ranks_, kFew) > kMostUneven * reached_ && lost_ >= mean_cut_seconds_;
}

void RankBalance::begin_anew(const Spread& loads, double slowness, double seconds) {
  reached_ = std::max(1.0, loads.uneven(ranks_, kFew));
  slowness_ = slowness;
  last_least_cost_ = mean_cost_ > 0 ? slowness * mean_cost_ : kUnknown;
  least_cost_ = kUnknown;
  steps_in_window_ = 0;
  cut_seconds_ = seconds;
  lost_ = 0;
}

}  // namespace hooke
