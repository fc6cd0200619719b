// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hooke::run {

std::string with_commas(std::uint64_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t at = 0; at < digits.size(); ++at) {
    if (at > 0 && (digits.size() - at) % 3 == 0) text += ',';
    text += digits[at];
  }
  return text;
}

std::string clock_time(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::llround(std::clamp(seconds, 0.0, 1e9)));
  const std::int64_t hours = whole / 3600;
  const std::int64_t minutes = whole / 60 % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60)
                   : fmt::format("{}:{:02}", minutes, whole % 60);
}

std::string ranks_and_threads(int ranks, int threads) {
  return ranks == 1 ? fmt::format("{} threads", threads) : fmt::format("{} ranks, {} threads", ranks, threads);
}

std::int64_t next_batch(std::int64_t steps, double seconds, double most_seconds) {
  const double a_step = std::max(seconds / static_cast<double>(steps), 1e-9);
  return static_cast<std::int64_t>(std::clamp(most_seconds / a_step, 1.0, 2 * static_cast<double>(steps)));
}

}  // namespace hooke::run
