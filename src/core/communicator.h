// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "hooke/core/backend.h"
#include "hooke/core/ledger_sums.h"

namespace hooke {

/// The communication in a step between the ranks that compute one scene together. Each rank's back end holds and
/// reports its own particles; every rank calls each of these functions at the same point of the same step.
class Communicator {
 public:
  virtual ~Communicator() = default;

  /// Whether there is one rank alone, to which the other functions do nothing.
  virtual bool is_serial() const = 0;

  /// Whether `here` is true on any rank.
  virtual bool any(bool here) = 0;

  /// The one to report of all ranks' conditions; good where all are good.
  virtual Condition first(const Condition& here) = 0;

  /// Before a neighbour list: moves every particle to the rank that owns its position, and renews the ghosts, copies of
  /// the other ranks' particles that may touch this rank's until the next list.
  virtual void migrate(Backend& backend) = 0;

  /// After particles have moved: updates the ghosts.
  virtual void update(Backend& backend) = 0;

  /// When the figures of the whole scene are read: each rank's sums become the sums over all ranks. Exact sums may be
  /// added in any order.
  virtual void sum(LedgerSums& sums) = 0;
  virtual void sum(MeasurementSums& sums) = 0;
  virtual void sum(std::uint64_t& count) = 0;  ///< modulo 2^64: of particles, of their hashes
};

/// For a scene on one rank alone.
class SerialCommunicator final : public Communicator {
 public:
  bool is_serial() const override { return true; }
  bool any(bool here) override { return here; }
  Condition first(const Condition& here) override { return here; }
  void migrate(Backend&) override {}
  void update(Backend&) override {}
  void sum(LedgerSums&) override {}
  void sum(MeasurementSums&) override {}
  void sum(std::uint64_t&) override {}
};

}  // namespace hooke
