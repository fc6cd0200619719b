// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "hooke/io/export.h"
#include "hooke/io/run_folder.h"

namespace hooke::io {

/// A checked call of export_run: at least one index, ascending, each < run.size().
struct ExportJob {
  const RunReader& run;
  std::span<const std::size_t> indices;  ///< snapshots of `run`
  std::filesystem::path file;
  const ExportOptions& options;
};

/// Writes the job's snapshots and returns the files that it wrote; the first is the one to open. Throws Failure.
using ExportFunction = std::vector<std::filesystem::path>(const ExportJob& job);

/// The file of snapshot `k` of `count` in a format with one snapshot per file: out/water.ply -> out/water_0007.ply.
std::filesystem::path numbered_file(const std::filesystem::path& file, std::size_t k, std::size_t count);

/// The files of an export that is going on: unless all are kept, they are removed, and an export that fails leaves
/// none.
class WrittenFiles {
 public:
  WrittenFiles() = default;
  ~WrittenFiles();
  WrittenFiles(const WrittenFiles&) = delete;
  WrittenFiles& operator=(const WrittenFiles&) = delete;

  void add(const std::filesystem::path& file) { files_.push_back(file); }
  std::vector<std::filesystem::path> keep() { return std::exchange(files_, {}); }

 private:
  std::vector<std::filesystem::path> files_;
};

/// For a format with one snapshot per file: calls write(index, file) for each snapshot of the job and returns the
/// files, which are numbered if there are several.
std::vector<std::filesystem::path> export_each(
    const ExportJob& job, const std::function<void(std::size_t, const std::filesystem::path&)>& write);

// One function per format, each in its own file; export.cpp lists them.
ExportFunction export_cloth_obj;
ExportFunction export_cloth_ply;
ExportFunction export_contacts_csv;
ExportFunction export_contacts_vtp;
ExportFunction export_csv;
ExportFunction export_lammps_data;
ExportFunction export_lammps_dump;
ExportFunction export_ply;
ExportFunction export_springs_csv;
ExportFunction export_surface_obj;
ExportFunction export_surface_ply;
ExportFunction export_usda;
ExportFunction export_vdb_points;
ExportFunction export_vdb_volume;
ExportFunction export_vtp;
ExportFunction export_xyz;

}  // namespace hooke::io
