// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/scene.h"
#include "hooke/io/run_folder.h"
#include "hooke/volumes/surface_options.h"

namespace hooke {

/// What of a snapshot is written.
enum class ExportContent { particles, contacts, surface, volume, cloths, springs };

/// "particles", "contacts", "surface", "volume", "cloths", "springs".
const char* to_string(ExportContent content);

struct ExportOptions {
  ExportContent content = ExportContent::particles;
  /// The rules of the run, with its materials: needed for contacts, which are computed from a snapshot by the law and
  /// its coefficients. Where other formats say the domain, the direction up or colours, they take them from here, and
  /// leave them out or fall back without. Cloths need its structure.
  const Scene* scene = nullptr;
  SurfaceOptions surface;
};

/// An extension that export_run knows for some content, with its dot, and what it stands for.
struct ExportFormatInfo {
  const char* extension;
  ExportContent content;
  const char* description;
};
std::vector<ExportFormatInfo> export_formats();

/// Writes snapshots (indices into `run`, each < run.size(), ascending, at least one) in the format that the extension
/// of `file` names for what the options ask for, and returns the files that were written, the one to open first. Each
/// is written beside and renamed. A format that holds one instant a file numbers several: FILE_0000.ply, FILE_0001.ply.
Expected<std::vector<std::filesystem::path>> export_run(const RunReader& run, std::span<const std::size_t> indices,
                                                        const std::filesystem::path& file,
                                                        const ExportOptions& options = {});

}  // namespace hooke
