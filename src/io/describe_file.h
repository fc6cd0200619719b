// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/io/snapshot.h"

namespace hooke::io {

/// What a file or folder written by Hooke holds.
struct FileDescription {
  enum class Kind { run_folder, particles_file, checkpoint };
  Kind kind = Kind::run_folder;
  RunInfo info;
  std::uint64_t bytes = 0;  ///< of the file, or of all files of the run

  std::vector<std::int64_t> steps;              ///< of the snapshots, or of a checkpoint's one state
  std::vector<double> times;                    ///< s
  std::vector<std::uint64_t> particle_counts;
  std::optional<std::int64_t> checkpoint_step;  ///< of a run folder that holds a checkpoint
};

/// Describes a run folder, particles.vtkhdf or checkpoint. bad_input, with the reason, if it is none or damaged.
Expected<FileDescription> describe_file(const std::filesystem::path& file);

/// "run folder", "snapshots", "checkpoint".
const char* to_string(FileDescription::Kind kind);

}  // namespace hooke::io
