// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "hooke/base/expected.h"

namespace hooke::cli {

/// Whether `file` can be written, said before hours of work and not after: its folder exists and takes files, and
/// it is no folder itself. `option` is what the error names, e.g. "--report".
Expected<void> check_output_file(const std::filesystem::path& file, const std::string& option);

}  // namespace hooke::cli
