// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hooke {

/// The one of `names` that `word` is most likely a misspelling of, or "" where none is near: fewest letters
/// inserted, left out, replaced or swapped with their neighbour, at most a third of the word, two at least.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// "; did you mean \"radius\"?", or "" where no name is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

/// The names in quotes with commas: `"a", "b"`; at most twenty of them.
std::string quoted_list(const std::vector<std::string>& names);

}  // namespace hooke
