// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hooke {

/// How evenly ranks share the work of a scene, and when other boxes pay. A unit of work is a particle in the force
/// pass; how long it takes is measured, as a mean over many steps. Each rank has one of these; what it decides from are
/// sums over all ranks, so that all decide alike.
class RankBalance {
 public:
  /// A number of each rank: their sum, and the largest.
  struct Spread {
    double sum = 0, most = 0;

    static Spread of(double here) { return {here, here}; }
    void add(const Spread& other) {
      sum += other.sum;
      most = most < other.most ? other.most : most;
    }
    /// The largest over the mean, 1 where there is nothing; `few` of it matter to nobody.
    double uneven(int ranks, double few = 0) const { return sum > 0 ? most / (sum / ranks + few) : 1; }
  };

  /// The time between two exchanges of particles. Sums over ranks are made by add().
  struct Interval {
    Spread seconds;  ///< that the ranks have computed
    Spread particles;  ///< that they had
    double recent_seconds = 0;  ///< of many steps, recent ones above all
    double recent_work = 0;  ///< in these steps
    double cut_seconds = 0;  ///< what the last cut took

    void add(const Interval& other);
  };

  explicit RankBalance(int ranks) : ranks_(ranks) {}

  /// A step is done, with so much work, which has taken this rank so long, s.
  void add_step(double seconds, double work) {
    ++steps_;
    seconds_ += seconds;
    work_ += work;
  }
  std::int64_t steps() const { return steps_; }  ///< since the last exchange

  /// This rank's part of the interval that ends with an exchange; and what all ranks' parts, added up, tell.
  Interval interval(std::uint64_t particles);
  void end_interval(const Interval& all);

  /// How long this rank takes for its work, over the mean of all ranks; 1 where too little is known.
  double slowness() const { return slowness_; }
  /// Whether boxes are to be cut, now that all ranks have such loads: work times slowness.
  bool wants_cut(const Spread& loads);
  /// Boxes have been cut. The loads are now expected to be these, the slowness and the work of this rank those, and the
  /// cut has taken so long here, s.
  void begin_anew(const Spread& loads, double slowness, double work, double seconds);
  /// All particles have been dealt out anew: nothing is known of them.
  void forget() { *this = RankBalance(ranks_); }

 private:
  int ranks_;
  std::int64_t steps_ = 0;  // since the last exchange
  double seconds_ = 0, work_ = 0;  // of them
  std::int64_t interval_steps_ = 0;  // of the last interval
  double recent_steps_ = 0;  // older ones count less; the same on all ranks
  double recent_seconds_ = 0, recent_work_ = 0;  // of them
  double mean_cost_ = 0;  // of a unit of work on any rank, s
  double slowness_ = 1;
  double reached_ = 1;  // the largest load over the mean that the last cut has left
  double lost_ = 0;  // by what has become uneven since then, s
  double cut_seconds_ = 0, mean_cut_seconds_ = 0;  // what the last cut has taken: here, on the mean
};

}  // namespace hooke
