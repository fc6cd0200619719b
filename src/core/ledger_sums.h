// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "hooke/core/ledger.h"
#include "hooke/core/scene.h"
#include "hooke/core/sums.h"

namespace hooke {

/// What the forces do in kicks of equal length, summed over these; or, times that length, over all kicks.
struct KickSums {
  ByCause<ExactSum> twice_power;    ///< at twice the mean of the velocities before and after the kick, W (J)
  ByCause<ExactVectorSum> force;    ///< N (N s)
  ExactSum spring_dissipation;      ///< W (J)

  friend bool operator==(const KickSums&, const KickSums&) = default;
};

/// The ledger as a run keeps it: exact sums over all steps so far, which read() rounds. A rank sums over its own
/// particles; the ranks' sums, added in any order, are the scene's, so a step needs no message between ranks.
struct LedgerSums {
  double kick = 0;  ///< length of the kicks, s: symplectic Euler's of one step each, velocity Verlet's of half one
  KickSums kicks;  ///< of all kicks of that length so far
  KickSums kick_to_come;  ///< velocity Verlet: of the half kick that the next step begins with
  KickSums settled;  ///< of the kicks before, of other lengths: times these
  RemovalSums departed;  ///< all that left, through open faces, at the end of their lives, or into sinks
  std::uint64_t expired = 0, sunk = 0;  ///< of those, the particles that left for these reasons
  RemovalSums born;
  ExactSum broken_energy;  ///< that was in springs as they broke, J
  std::uint64_t broken = 0;  ///< springs

  /// Books what the evaluation of a step did. Symplectic Euler kicks once; velocity Verlet by half a step with the
  /// forces of the last evaluation, and by half a step with these.
  void book_step(const StepReport& now, const Scene& scene);
  /// Velocity Verlet: replaces what the first half of the next step will do by what an evaluation of all forces found.
  void book_start(const StepReport& start, const Scene& scene);

  void book_left(const RemovalSums& left) { departed.add(left); }  ///< through open faces
  void book_expired(const RemovalSums& gone) {
    departed.add(gone);
    expired += gone.count;
  }
  void book_sunk(const RemovalSums& gone) {
    departed.add(gone);
    sunk += gone.count;
  }
  void book_born(const RemovalSums& newborn) { born.add(newborn); }

  /// Adds another rank's sums.
  void add(const LedgerSums& other);

  /// The figures, each rounded a few times: exact sums, their products with the lengths of kicks, and sums of these.
  Ledger read() const;

  friend bool operator==(const LedgerSums&, const LedgerSums&) = default;

  /// visit(sum, ...) for each exact sum of these ledgers, and visit(count, ...) for each count, always in the same
  /// order: that of a checkpoint.
  template <class Visit, class... Sums>
  static void for_each_sum(const Visit& visit, Sums&... of) {
    for_each_sum_of_kicks(visit, of.kicks...);
    for_each_sum_of_kicks(visit, of.kick_to_come...);
    for_each_sum_of_kicks(visit, of.settled...);
    for (int axis = 0; axis < 3; ++axis) visit(of.departed.momentum[axis]...);
    visit(of.departed.energy...);
    visit(of.departed.elastic...);
    for (int axis = 0; axis < 3; ++axis) visit(of.born.momentum[axis]...);
    visit(of.born.energy...);
    visit(of.born.elastic...);
    visit(of.broken_energy...);
  }
  template <class Visit, class... Sums>
  static void for_each_count(const Visit& visit, Sums&... of) {
    visit(of.departed.count...);
    visit(of.born.count...);
    visit(of.expired...);
    visit(of.sunk...);
    visit(of.broken...);
  }

 private:
  void settle(double next_kick);

  template <class Visit, class... Kicks>
  static void for_each_sum_of_kicks(const Visit& visit, Kicks&... of) {
    for (std::size_t cause = 0; cause < kCauses; ++cause) visit(of.twice_power.of[cause]...);
    for (std::size_t cause = 0; cause < kCauses; ++cause) {
      for (int axis = 0; axis < 3; ++axis) visit(of.force.of[cause][axis]...);
    }
    visit(of.spring_dissipation...);
  }
};

}  // namespace hooke
