// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "command_list.h"

namespace hooke::manual {

/// The page hooke(1), as roff. `version`: of the program, "0.1.0".
std::string program_page(const ProgramText& text, const std::string& version);

/// The page hooke-COMMAND(1), as roff.
std::string command_page(const CommandText& command, const std::string& version);

}  // namespace hooke::manual
