// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "hooke/base/assert.h"
#include "hooke/run/numbers.h"

namespace hooke::cli {
namespace {

constexpr std::chrono::milliseconds kTerminalInterval{200};
constexpr std::chrono::seconds kPipeInterval{10};
constexpr std::chrono::seconds kRateWindow{5};

}  // namespace

StatusLine::StatusLine(bool wanted) : wanted_(wanted), terminal_(isatty(STDOUT_FILENO) != 0), printed_(Clock::now()) {}

StatusLine::~StatusLine() { clear(); }

bool StatusLine::due() const {
  const Clock::duration interval = terminal_ ? Clock::duration(kTerminalInterval) : Clock::duration(kPipeInterval);
  return wanted_ && Clock::now() - printed_ >= interval;
}

void StatusLine::show(const std::string& text) {
  printed_ = Clock::now();
  fmt::print("{}{}{}", terminal_ ? "\r\x1b[K" : "", text, terminal_ ? "" : "\n");
  std::fflush(stdout);
  shown_ = terminal_;
}

void StatusLine::clear() {
  if (!shown_) return;
  fmt::print("\r\x1b[K");
  std::fflush(stdout);
  shown_ = false;
}

Progress::Progress(std::int64_t first, std::int64_t last, double time_step, bool wanted)
    : last_(last),
      time_step_(time_step),
      wanted_(wanted),
      status_(wanted),
      recent_{{Clock::now(), first}} {
  HOOKE_ASSERT(first <= last && time_step > 0, first, last, time_step);
}

void Progress::update(std::int64_t step, std::uint64_t particles) {
  if (!wanted_) return;
  const Clock::time_point now = Clock::now();
  recent_.push_back({now, step});
  while (recent_.size() > 2 && now - recent_[1].at > kRateWindow) recent_.pop_front();
  status_.update([&] { return line(step, particles); });
}

void FrameProgress::update(std::int64_t done) {
  HOOKE_ASSERT(done > 0 && done <= count_, done, count_);
  status_.update([&] {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const double a_frame = seconds / static_cast<double>(done);
    return fmt::format("frame {} of {}   {:.2f} s a frame   left {}", done, count_, a_frame,
                       run::clock_time(a_frame * static_cast<double>(count_ - done)));
  });
}

std::string Progress::line(std::int64_t step, std::uint64_t particles) const {
  const double seconds = std::chrono::duration<double>(recent_.back().at - recent_.front().at).count();
  const double rate = seconds > 0 ? static_cast<double>(step - recent_.front().step) / seconds : 0;
  const double now = static_cast<double>(step) * time_step_;
  const double end = static_cast<double>(last_) * time_step_;
  std::string text = fmt::format("t {:.3f} of {:.3f} s   {:.1f} steps/s   {:.2f} M particle-steps/s", now, end, rate,
                                 rate * static_cast<double>(particles) * 1e-6);
  if (rate > 0) text += "   left " + run::clock_time(static_cast<double>(last_ - step) / rate);
  return text;
}

}  // namespace hooke::cli
