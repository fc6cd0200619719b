// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace hooke::scene {

/// `text` without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// `text` without the byte order mark (UTF-8) that some programs put first.
std::string_view without_byte_order_mark(std::string_view text);

/// Line ends in the bytes [from, to) of `text`: LF, CR and CRLF, which counts where its LF is.
std::size_t count_line_ends(std::string_view text, std::size_t from, std::size_t to);

/// Splits a line at blanks into `words`.
void split_words(std::string_view line, std::vector<std::string_view>& words);

/// Removes the next word from `line` and returns it; empty where there is none.
std::string_view take_word(std::string_view& line);

/// Reads all of `text` as a finite number, also "+1.5"; one too small for a double is 0. False where it is no number.
bool read_number(std::string_view text, double& value);

/// Reads all of `text` as a whole number. False where it is none or too large.
bool read_count(std::string_view text, std::uint64_t& value);

}  // namespace hooke::scene
