// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hooke::cli {

/// While an Interrupt exists, SIGINT, SIGTERM, SIGHUP and SIGUSR1 only ask to stop. A second one of the same signal
/// ends the program at once, as it would without an Interrupt. SIGUSR1 is what mpirun hands on to the ranks.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// Whether a signal has asked to stop.
  bool requested() const;
};

}  // namespace hooke::cli
