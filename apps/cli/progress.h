// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <string>

namespace hooke::cli {

/// Shows progress: on a terminal as one line that is rewritten, on a pipe as a plain line every ten seconds.
class StatusLine {
 public:
  /// Silent unless `wanted`.
  explicit StatusLine(bool wanted);
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// Prints text() when an update is due.
  template <class Text>
  void update(const Text& text) {
    if (due()) show(text());
  }
  /// Removes the line from the terminal, so that other text can be printed.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool due() const;
  void show(const std::string& text);

  bool wanted_;
  bool terminal_;
  bool shown_ = false;
  Clock::time_point printed_;
};

/// Shows how far a run has got.
class Progress {
 public:
  /// A run from step `first` to step `last` of `time_step` seconds (> 0) each. Silent unless `wanted`.
  Progress(std::int64_t first, std::int64_t last, double time_step, bool wanted);

  /// `step` steps are done and `particles` exist. Cheap: prints only when an update is due.
  void update(std::int64_t step, std::uint64_t particles);
  void clear() { status_.clear(); }

 private:
  using Clock = std::chrono::steady_clock;
  struct Sample {
    Clock::time_point at;
    std::int64_t step;
  };

  std::string line(std::int64_t step, std::uint64_t particles) const;

  std::int64_t last_;
  double time_step_;
  bool wanted_;
  StatusLine status_;
  std::deque<Sample> recent_;  // of the last seconds, for the rate
};

/// Shows how many of a film's frames are drawn.
class FrameProgress {
 public:
  explicit FrameProgress(std::int64_t count) : count_(count) {}
  /// `done` (> 0) frames are drawn.
  void update(std::int64_t done);

 private:
  std::int64_t count_;
  StatusLine status_{true};
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace hooke::cli
