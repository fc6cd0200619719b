// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace hooke::run {

/// "512,000": a whole number with commas between thousands.
std::string with_commas(std::uint64_t number);
/// "1:02:03" or "2:03".
std::string clock_time(double seconds);
/// "2 threads" of one rank, "3 ranks, 6 threads" of several.
std::string ranks_and_threads(int ranks, int threads);

/// How many steps (>= 1) to take at once so that they take about `most_seconds`, after `steps` (>= 1) took `seconds`:
/// at most twice as many, because steps may get slower.
std::int64_t next_batch(std::int64_t steps, double seconds, double most_seconds);

}  // namespace hooke::run
