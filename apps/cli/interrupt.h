// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hooke::cli {

/// While an Interrupt exists, SIGINT, SIGTERM and SIGHUP only ask to stop. A second signal ends the program at once, as
/// it would without an Interrupt.
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
