// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace hooke {

/// `text` without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// `line`, the first one of a file, without the byte order mark that some programs write before UTF-8.
std::string_view without_byte_order_mark(std::string_view line);

/// Splits a line at blanks into `words`.
void split_words(std::string_view line, std::vector<std::string_view>& words);

/// Removes the next word from `line` and returns it; empty where there is none.
std::string_view take_word(std::string_view& line);

/// Reads all of `text` as a finite number, also "+1.5"; one too small for a double is 0. False where it is no number.
bool read_number(std::string_view text, double& value);

/// Reads all of `text` as a whole number. False where it is none or too large.
bool read_count(std::string_view text, std::uint64_t& value);

}  // namespace hooke
