// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "arguments.h"
#include "hooke/base/expected.h"

namespace hooke::cli {

/// Makes spdlog's default logger write warnings and errors to stderr, only errors if `quiet`. Any thread may log; the
/// thread that draws a film does.
void start_log(bool quiet);

/// From now on also appends all messages to `file`. To be called while no other thread logs.
Expected<void> log_to_file(const std::filesystem::path& file);

/// Prints a warning of the loader.
void report_warning(const Finding& warning);

/// Prints every finding. A file that can't be read or written is bad input before a run starts and a failed run after.
ExitStatus report_error(const Error& error, bool running = false);

}  // namespace hooke::cli
