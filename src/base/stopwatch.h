// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace hooke {

/// Adds the wall time from its construction to stop(), or to the end of its scope, to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(&seconds), start_(Clock::now()) {}
  ~Stopwatch() { stop(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

  /// Later calls do nothing.
  void stop() {
    if (seconds_ == nullptr) return;
    *seconds_ += std::chrono::duration<double>(Clock::now() - start_).count();
    seconds_ = nullptr;
  }

 private:
  using Clock = std::chrono::steady_clock;
  double* seconds_;
  Clock::time_point start_;
};

}  // namespace hooke
