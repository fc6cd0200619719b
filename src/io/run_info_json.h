// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "hooke/io/snapshot.h"

namespace hooke::io {

/// Converts a RunInfo to the JSON stored in every binary file of a run, and back. Throws Failure that names `file`.
std::string to_json(const RunInfo& info);
RunInfo parse_run_info(const std::string& json, const std::filesystem::path& file);

}  // namespace hooke::io
