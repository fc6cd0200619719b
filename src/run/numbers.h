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

}  // namespace hooke::run
