// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "hooke/core/particle_slices.h"
#include "hooke/io/hdf5_library.h"
#include "hooke/io/snapshot.h"

namespace hooke::io {

namespace hdf5 {
class File;
}

/// The table of contents of a particles.vtkhdf: one entry per snapshot.
struct ParticlesContents {
  RunInfo info;
  std::vector<std::int64_t> steps;
  std::vector<double> times;             ///< s
  std::vector<std::uint64_t> particles;  ///< number of particles
};

/// Writes particles.vtkhdf: temporal PolyData of VTKHDF 2.0, one vertex per particle
/// (https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/vtkhdf_specifications.html).
/// Each snapshot is one commit of the underlying JournaledFile. Throws Failure; callers hold hdf5::lock().
///
/// Unchanged data is stored once, and later steps refer to it: ids, materials and radii while the particles stay the
/// same, the list of vertices while their number stays the same. Snapshots start at whole chunks, so no chunk is ever
/// written twice.
class ParticlesFile {
 public:
  /// Creates a file, which appears under its name when it is complete.
  static ParticlesFile create(const std::filesystem::path& path, const RunInfo& info);
  /// Opens an existing file and cuts it after the last snapshot with a step below `end_step`. `info` replaces the
  /// file's description of its run.
  static ParticlesFile update(const std::filesystem::path& path, const RunInfo& info, std::int64_t end_step);

  ~ParticlesFile();
  ParticlesFile(ParticlesFile&&) noexcept;
  ParticlesFile& operator=(ParticlesFile&&) noexcept;

  /// Steps must ascend.
  void append(std::int64_t step, double time, const ParticleSlices& particles);
  std::optional<std::int64_t> last_step() const { return last_step_; }

  /// Makes the appended snapshots survive a power failure too.
  void sync() const;

 private:
  struct Columns;
  ParticlesFile(hdf5::File file, const RunInfo& info);
  void write_snapshot(std::int64_t step, double time, const ParticleSlices& particles);
  void cut(std::size_t snapshots);

  RunInfo info_;
  std::unique_ptr<hdf5::File> file_;
  std::unique_ptr<Columns> columns_;  // null before the first snapshot, which determines the size of chunks
  std::optional<std::int64_t> last_step_;
};

/// Reads a file's table of contents. Throws Failure; callers hold hdf5::lock().
ParticlesContents read_particles_contents(const std::filesystem::path& path);
/// Reads snapshot `index` of a file.
Snapshot read_particles(const std::filesystem::path& path, std::size_t index);

}  // namespace hooke::io
