// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hooke {

// How messages show names and other text that comes from a file or from the command line. A name may hold anything, and
// a terminal obeys the control characters that it is sent.

/// `text` on one line, cut after at most `most` bytes. Invalid UTF-8 becomes U+FFFD; control characters and those that
/// turn the direction of writing become escapes, as in JSON: "\n", "\u001b".
std::string printable(std::string_view text, std::size_t most = 200);

/// The step to the member `key` in the path of a value: ".radius", or quoted where the key has other characters than
/// letters, digits, '_', '-' and '$': "[\"salt water\"]". Escapes are as in printable(), with \" and \\ beside them, so
/// that no two keys have the same step.
std::string path_step(std::string_view key);

}  // namespace hooke
