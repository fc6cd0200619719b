// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/io/checkpoint.h"
#include "hooke/io/report.h"
#include "hooke/io/series.h"
#include "hooke/io/snapshot.h"

namespace hooke {

/// Files of a run folder.
inline constexpr const char* kSceneFile = "scene.json";
inline constexpr const char* kParticlesFile = "particles.vtkhdf";
inline constexpr const char* kSeriesFile = "series.csv";
inline constexpr const char* kCheckpointFile = "checkpoint.h5";
inline constexpr const char* kLogFile = "log.txt";
inline constexpr const char* kReportFile = "report.json";

/// Whether `folder` holds files of a run.
bool holds_run(const std::filesystem::path& folder);

/// Writes a run folder. Snapshots and checkpoints are written by a thread of its own, in the order given; one may
/// wait while another is written, a third makes the caller wait. What goes wrong there (a full disk) is returned by
/// the next call and by every one after it; what was complete before stays readable. Not thread-safe.
class RunWriter {
 public:
  struct Options {
    bool overwrite = false;  ///< replaces a run that is there; files of others are left alone
  };

  /// Starts a new run. `scene_json` is the scene as resolved. bad_input where the folder holds a run, io where it
  /// can't be written; then nothing new is left behind.
  static Expected<RunWriter> create(const std::filesystem::path& folder, const RunInfo& info,
                                    const std::string& scene_json, const Options& options);

  /// Goes on in a folder from a checkpoint of `step` (>= 0): snapshots and rows of later steps are cut, and so are
  /// those of this very step unless it is due by `cadence` (they were there because the run ended), so that the files
  /// become those of a run that never stopped.
  static Expected<RunWriter> resume(const std::filesystem::path& folder, const RunInfo& info,
                                    const std::string& scene_json, std::int64_t step, const OutputCadence& cadence);

  /// Without finish() before, waits for what is queued and forgets its errors.
  ~RunWriter();
  RunWriter(RunWriter&&) noexcept;
  RunWriter& operator=(RunWriter&&) noexcept;

  const std::filesystem::path& folder() const;
  std::filesystem::path log_path() const;
  std::filesystem::path checkpoint_path() const;

  /// Queues a snapshot. Steps ascend; a step that has been written already is not written twice.
  Expected<void> write_snapshot(std::shared_ptr<const Snapshot> snapshot);
  Expected<void> write_snapshot(Snapshot snapshot);
  /// Queues the checkpoint that replaces the one there, after all snapshots queued before it.
  Expected<void> write_checkpoint(SimulationState state);
  /// Appends a row to series.csv at once. A step that has been written already is not written twice.
  Expected<void> write_series(const SeriesRow& row);
  Expected<void> write_report(const RunReport& report);

  /// Waits until everything queued is in its file; the first error, if there was one.
  Expected<void> flush();
  /// flush(), syncs to the disk and closes. Nothing may be written after it.
  Expected<void> finish();

 private:
  struct Impl;
  explicit RunWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Reads the snapshots of a run, finished, running or killed.
class RunReader {
 public:
  /// `run` is a run folder or its particles.vtkhdf. bad_input, and why, where it is missing, no run or damaged.
  static Expected<RunReader> open(const std::filesystem::path& run);

  ~RunReader();
  RunReader(RunReader&&) noexcept;
  RunReader& operator=(RunReader&&) noexcept;

  const RunInfo& info() const;
  const std::filesystem::path& file() const;  ///< the particles.vtkhdf
  std::size_t size() const;  ///< complete snapshots; may be 0
  std::span<const std::int64_t> steps() const;
  std::span<const double> times() const;  ///< s
  std::span<const std::uint64_t> particle_counts() const;

  /// Index of the snapshot of this step, or of the one nearest in time (the earlier of two), where there is one.
  std::optional<std::size_t> find_step(std::int64_t step) const;
  std::optional<std::size_t> find_time(double seconds) const;

  /// Snapshot `index` < size(), particles by ascending id.
  Expected<Snapshot> read(std::size_t index) const;

 private:
  struct Impl;
  explicit RunReader(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace hooke
