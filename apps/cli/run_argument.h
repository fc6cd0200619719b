// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "hooke/base/expected.h"

namespace hooke::cli {

/// Checks that the RUN of `command` ("render") is not a scene file, nor another JSON file: bad_input says how to run
/// the scene first, or which folder is meant. A path of any other kind passes; who opens it says what is wrong with it.
Expected<void> check_run_argument(const std::filesystem::path& run, const std::string& command);

}  // namespace hooke::cli
