// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "hooke/io/hdf5.h"
#include "hooke/io/snapshot.h"

namespace hooke {

/// The table of contents of a particles.vtkhdf: one entry a snapshot.
struct ParticlesContents {
  RunInfo info;
  std::vector<std::int64_t> steps;
  std::vector<double> times;             ///< s
  std::vector<std::uint64_t> particles;  ///< how many
};

/// Writes particles.vtkhdf: temporal PolyData of VTKHDF 2.0, one vertex a particle
/// (https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/vtkhdf_specifications.html).
/// Each snapshot is one commit of the JournaledFile underneath. Throws Failure; callers hold hdf5::lock().
///
/// What does not change is stored once, and later steps point to it: ids, materials and radii while the same
/// particles are there, the list of vertices while there are as many. Snapshots start at whole chunks, so that
/// no chunk is ever written twice.
class ParticlesFile {
 public:
  /// A new file, which appears under its name when it is whole.
  static ParticlesFile create(const std::filesystem::path& path, const RunInfo& info);
  /// One that is there, cut after the last snapshot with a step below `end_step`. `info` takes the place of what it
  /// said about its run.
  static ParticlesFile update(const std::filesystem::path& path, const RunInfo& info, std::int64_t end_step);

  ~ParticlesFile();
  ParticlesFile(ParticlesFile&&) noexcept;
  ParticlesFile& operator=(ParticlesFile&&) noexcept;

  /// Steps ascend.
  void append(const Snapshot& snapshot);
  std::optional<std::int64_t> last_step() const { return last_step_; }

  /// What was appended survives a power failure too.
  void sync();

 private:
  struct Columns;
  ParticlesFile(hdf5::File file, RunInfo info);
  void write_snapshot(const Snapshot& snapshot);
  void cut(std::size_t snapshots);

  RunInfo info_;
  hdf5::File file_;
  std::unique_ptr<Columns> columns_;  // none before the first snapshot: it rules the size of chunks
  std::optional<std::int64_t> last_step_;
};

/// Reads it. Throws Failure; callers hold hdf5::lock().
ParticlesContents read_particles_contents(const std::filesystem::path& path);
/// Snapshot `index` of it.
Snapshot read_particles(const std::filesystem::path& path, std::size_t index);

}  // namespace hooke
