// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace hooke {

/// `text` without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// The words of a line, between blanks, into `words`.
void split_words(std::string_view line, std::vector<std::string_view>& words);

/// Takes the next word off `line`; empty where there is none.
std::string_view take_word(std::string_view& line);

/// All of `text` as a finite number, "+1.5" too. What is too small for a double is 0. False where it is none.
bool read_number(std::string_view text, double& value);

/// All of `text` as a whole number. False where it is none, or larger than fits.
bool read_count(std::string_view text, std::uint64_t& value);

}  // namespace hooke
