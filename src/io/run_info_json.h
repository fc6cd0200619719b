// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "hooke/io/snapshot.h"

namespace hooke {

/// A RunInfo as every binary file of a run holds it, and back. Throws Failure, naming `file`.
std::string to_json(const RunInfo& info);
RunInfo parse_run_info(const std::string& json, const std::filesystem::path& file);

}  // namespace hooke
