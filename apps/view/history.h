// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <memory>

#include "session.h"

namespace hooke::view {

/// Figures over time, for plots.
class History {
 public:
  struct Sample {
    std::int64_t steps = 0;
    double time = 0;                                        ///< s
    double kinetic = 0, potential = 0, elastic = 0, total = 0;  ///< J, less what there was at the start
    double contacts = 0;
    double step_seconds = 0;
    StageTimes stages;  ///< s a step
  };

  /// Adds figures that are new. Drops what was taken back.
  void add(const std::shared_ptr<const Figures>& figures, const Readings& now);
  const std::deque<Sample>& samples() const { return samples_; }

 private:
  std::shared_ptr<const Figures> last_;
  std::deque<Sample> samples_;
};

/// Draws the plots into the ImGui window that is open.
void draw_plots(const History& history);

}  // namespace hooke::view
