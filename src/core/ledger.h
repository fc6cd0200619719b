// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "hooke/base/vec3.h"
#include "hooke/core/work.h"

namespace hooke {

/// What became of the energy of the structure's springs.
struct SpringLedger {
  double dissipated = 0;     ///< by dampers, J; part of the springs' work
  double broken_energy = 0;  ///< that was in springs as they broke, J
  std::uint64_t broken = 0;  ///< springs

  friend bool operator==(const SpringLedger&, const SpringLedger&) = default;
};

/// Births, and departures other than through open faces.
struct PopulationLedger {
  Vec3d born_momentum{0, 0, 0};  ///< brought along by those born, kg m/s
  double born_energy = 0;        ///< kinetic and potential, likewise, J
  std::uint64_t born = 0;        ///< particles, by emitters
  std::uint64_t expired = 0;     ///< particles whose life ended
  std::uint64_t sunk = 0;        ///< taken away by sinks

  friend bool operator==(const PopulationLedger&, const PopulationLedger&) = default;
};

/// The totals of a run: sums over all steps so far, each rounded once from an exact sum
/// (LedgerSums), so that its bits are the same for any number of threads and across a restart.
struct Ledger {
  Work work;  ///< J
  /// Impulse given to particles, N s. Causes that act between particles give none; attraction gives the tree's
  /// deviation from Newton's third law.
  ByCause<Vec3d> impulse;
  Vec3d removed_momentum{0, 0, 0};  ///< taken along by particles that left, expired or sank, kg m/s
  double removed_energy = 0;        ///< kinetic and potential, taken along likewise, J
  /// Energy in contacts between particles and in springs when a particle left, expired or sank, less the energy in
  /// contacts of newborns, J.
  double removed_elastic = 0;
  std::uint64_t removed = 0;  ///< particles that left through open faces
  PopulationLedger population;
  SpringLedger springs;

  /// Taken out by the dashpots and the friction of contacts between particles, and by drag, J.
  double dissipated() const {
    return 0 - (work[Cause::contact_shear] + work[Cause::contact_damping] + work[Cause::contact_friction] +
                work[Cause::drag]);
  }

  friend bool operator==(const Ledger&, const Ledger&) = default;
};

}  // namespace hooke
