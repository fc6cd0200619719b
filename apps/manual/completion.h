// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "command_list.h"

namespace hooke::manual {

/// A script that completes commands, options, choices and files of the program in bash.
std::string bash_completion(const ProgramText& text);

/// The same for zsh.
std::string zsh_completion(const ProgramText& text);

}  // namespace hooke::manual
