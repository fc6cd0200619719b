// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hooke/io/run_folder.h"

namespace hooke::samples {

/// A folder that is removed with this object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Two materials, dt 0.005 s.
io::RunInfo run_info(Precision precision = Precision::single_precision);

/// `n` particles with random positions and velocities that depend on the step: the same call gives the same bits.
ParticleSet particles(std::int64_t step, std::size_t n, Precision precision);
Snapshot snapshot(std::int64_t step, std::size_t n, Precision precision = Precision::single_precision);
/// A state with every field set.
SimulationState state(std::int64_t step, std::size_t n);
io::SeriesRow series_row(std::int64_t step);

/// A scene of these materials, with colours, in a domain that holds the particles; periodic along y, up is z.
Scene scene(const io::RunInfo& info);
/// Writes a run of these snapshots and opens it. Throws where that fails.
io::RunReader write_run(const std::filesystem::path& folder, const io::RunInfo& info,
                        const std::vector<Snapshot>& snapshots);
/// Exports all snapshots of a run and returns the files. Throws where that fails.
std::vector<std::filesystem::path> export_all(const io::RunReader& run, const std::filesystem::path& file,
                                              const Scene* scene = nullptr);

/// Whether ids, materials, positions and velocities (and accelerations) are the same bits.
bool same(const ParticleSet& a, const ParticleSet& b);
bool same(const Snapshot& a, const Snapshot& b);

std::string read_file(const std::filesystem::path& file);
void write_file(const std::filesystem::path& file, const std::string& content);
std::vector<std::string> files_in(const std::filesystem::path& folder);

/// The words of a line, between white space.
std::vector<std::string> words(const std::string& line);
/// A number that a run of this precision wrote; throws where the text holds anything else.
double number(const std::string& text, Precision precision = Precision::double_precision);
/// The output of a shell command; throws, with the output, where the command fails.
std::string output_of(const std::string& command);

}  // namespace hooke::samples
