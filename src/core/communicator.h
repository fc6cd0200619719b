// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "hooke/core/backend.h"
#include "hooke/core/ledger_sums.h"

namespace hooke {

/// What the ranks that compute one scene together tell each other in a step. Each rank's back end holds and reports of
/// its own particles; every rank calls each of these at the same place of the same step.
class Communicator {
 public:
  virtual ~Communicator() = default;

  /// Whether it is so on any rank.
  virtual bool any(bool here) = 0;

  /// Of what the ranks have found the one to report; good where all are.
  virtual Condition first(const Condition& here) = 0;

  /// Before a neighbour list: every particle to the rank that owns its place, and anew the ghosts, copies of the other
  /// ranks' particles that may touch one of these until the next list.
  virtual void migrate(Backend& backend) = 0;

  /// After particles have moved: ghosts to where they are now.
  virtual void update(Backend& backend) = 0;

  /// When the figures of the whole scene are read: the sums of all ranks become one, the same on each. Exact sums may
  /// be added in any order.
  virtual void sum(LedgerSums& sums) = 0;
  virtual void sum(MeasurementSums& sums) = 0;
  virtual void sum(std::uint64_t& count) = 0;  ///< modulo 2^64: of particles, of their hashes
};

/// A scene on one rank, which has no other to talk to.
class SerialCommunicator final : public Communicator {
 public:
  bool any(bool here) override { return here; }
  Condition first(const Condition& here) override { return here; }
  void migrate(Backend&) override {}
  void update(Backend&) override {}
  void sum(LedgerSums&) override {}
  void sum(MeasurementSums&) override {}
  void sum(std::uint64_t&) override {}
};

}  // namespace hooke
