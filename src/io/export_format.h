// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "hooke/io/run_folder.h"

namespace hooke {

/// Writes the snapshots `indices` (at least one, ascending) of `run` to `file`, and returns the files that it wrote,
/// the one to open first. Throws Failure.
using ExportFunction = std::vector<std::filesystem::path>(const RunReader& run, std::span<const std::size_t> indices,
                                                          const std::filesystem::path& file);

// One a format, each in a file of its own; export.cpp lists them.
ExportFunction export_csv;
ExportFunction export_vtp;
ExportFunction export_pvd;

}  // namespace hooke
