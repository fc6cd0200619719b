// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hooke::scene {

/// The entry of `names` that `word` most likely misspells, or "" where none is near: the one with the fewest letters
/// inserted, left out, replaced or swapped with their neighbour, at most a third of the word or two, whichever is more.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// "; did you mean \"radius\"?", or "" where no name is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

/// The names in quotes with commas: `"a", "b"`; at most twenty of them, each as messages show it.
std::string quoted_list(const std::vector<std::string>& names);

}  // namespace hooke::scene
