// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "commands.h"
#include "hooke/base/expected.h"

namespace hooke::cli {

/// Makes spdlog's default logger write warnings and errors to stderr, errors alone where `quiet`.
void start_log(bool quiet);

/// From now on everything goes to `file` too, which is appended to.
Expected<void> log_to_file(const std::filesystem::path& file);

/// Prints every finding. What can't be read or written is bad input before a run has begun, and a failed run after.
ExitStatus report_error(const Error& error, bool running = false);

}  // namespace hooke::cli
