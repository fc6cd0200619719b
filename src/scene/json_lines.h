// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hooke::scene {

/// The lines of a JSON text that hold the values at these paths, from 1. A missing value has the line of the object
/// that lacks it; 0 where there is none either. Reads the text once: lines are only asked for where something is wrong,
/// so they are not kept for every value.
std::vector<int> lines_of(std::string_view text, const std::vector<std::string>& paths);

}  // namespace hooke::scene
