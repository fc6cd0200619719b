// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "hooke/base/expected.h"

namespace hooke::run {

/// Checks that `file` can be written, before hours of work and not after: its folder exists and is writable, and it is
/// not a folder itself. `option` is the name in the error, e.g. "--report".
Expected<void> check_output_file(const std::filesystem::path& file, const std::string& option);

}  // namespace hooke::run
