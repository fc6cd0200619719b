// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/io/run_folder.h"

namespace hooke {

/// Extensions that export_run knows, with their dot, and what they stand for.
struct ExportFormatInfo {
  const char* extension;
  const char* description;
};
std::vector<ExportFormatInfo> export_formats();

/// Writes snapshots (indices into `run`, ascending, at least one) in the format that the extension of `file` names,
/// and returns the files that were written, the one to open first. Each is written beside and renamed. CSV holds
/// them all in one file; .vtp holds one, several become FILE.pvd with one numbered .vtp each.
Expected<std::vector<std::filesystem::path>> export_run(const RunReader& run, std::span<const std::size_t> indices,
                                                        const std::filesystem::path& file);

}  // namespace hooke
