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

namespace hooke::io {

/// Which content of a snapshot is exported.
enum class ExportContent { particles, contacts, surface, volume, cloths, springs };

/// "particles", "contacts", "surface", "volume", "cloths", "springs".
const char* to_string(ExportContent content);

struct ExportOptions {
  ExportContent content = ExportContent::particles;
  /// The rules of the run, with its materials. Contacts need it: they are computed from a snapshot with the law and its
  /// coefficients. Cloths need its structure. Other formats take the domain, the upward direction or colours from it;
  /// without it they omit them or use defaults.
  const Scene* scene = nullptr;
  volumes::SurfaceOptions surface;
};

/// An extension that export_run knows for some content, with its dot, and a description.
struct ExportFormatInfo {
  const char* extension;
  ExportContent content;
  const char* description;
};
std::vector<ExportFormatInfo> export_formats();

/// Writes snapshots (indices into `run`, each < run.size(), ascending, at least one) in the format that the extension
/// of `file` names for the requested content. Returns the files written, the one to open first at the front; each is
/// written beside and renamed. A format with one snapshot per file numbers several: FILE_0000.ply, FILE_0001.ply.
Expected<std::vector<std::filesystem::path>> export_run(const RunReader& run, std::span<const std::size_t> indices,
                                                        const std::filesystem::path& file,
                                                        const ExportOptions& options = {});

}  // namespace hooke::io
