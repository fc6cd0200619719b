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

namespace hooke::io {

class RunLock;

/// Files of a run folder.
inline constexpr const char* kSceneFile = "scene.json";
inline constexpr const char* kParticlesFile = "particles.vtkhdf";
inline constexpr const char* kSeriesFile = "series.csv";
inline constexpr const char* kCheckpointFile = "checkpoint.h5";
inline constexpr const char* kLogFile = "log.txt";
inline constexpr const char* kReportFile = "report.json";
inline constexpr const char* kLockFile = ".hooke.lock";  // only while the folder is written

/// Whether `folder` holds files of a run.
Expected<bool> holds_run(const std::filesystem::path& folder);

/// bad_input, with the process, where one writes the run in `folder` now. RunWriter looks again.
Expected<void> check_not_written(const std::filesystem::path& folder);

/// Writes a run folder. Its own thread writes snapshots and checkpoints, in the order given; one may wait while another
/// is written, and a third makes the caller wait. An error of the thread (a full disk) is returned by the next call
/// that queues or waits and by all such calls after it; everything complete before stays readable. Not thread-safe.
/// The folder is locked until finish() or the end of the writer: a second writer, of any process, is refused.
class RunWriter {
 public:
  struct Options {
    bool overwrite = false;  ///< replaces an existing run; other files are left alone
  };

  /// Starts a new run. `scene_json` is the resolved scene. bad_input where the folder already holds a run or is being
  /// written, io where it can't be written; then no new files are left behind.
  static Expected<RunWriter> create(const std::filesystem::path& folder, const RunInfo& info,
                                    const std::string& scene_json, const Options& options);

  /// Continues a run in its folder from a checkpoint of `step` (>= 0). Cuts snapshots and rows of later steps, and
  /// those of `step` itself unless `cadence` makes it due (they were written because the run ended), so that the files
  /// become those of an uninterrupted run. bad_input where the folder is being written.
  static Expected<RunWriter> resume(const std::filesystem::path& folder, const RunInfo& info,
                                    const std::string& scene_json, std::int64_t step, const OutputCadence& cadence);

  /// Without finish(), waits for queued items and drops their errors.
  ~RunWriter();
  RunWriter(RunWriter&&) noexcept;
  RunWriter& operator=(RunWriter&&) noexcept;

  const std::filesystem::path& folder() const;
  std::filesystem::path log_path() const;
  std::filesystem::path checkpoint_path() const;

  /// Queues a snapshot. Steps must ascend; a step that was already written is not written again.
  Expected<void> write_snapshot(std::shared_ptr<const Snapshot> snapshot);
  Expected<void> write_snapshot(Snapshot snapshot);
  /// Writes a snapshot at once, after what is queued, where its particles come in slices. `time`: s.
  Expected<void> write_snapshot(std::int64_t step, double time, const ParticleSlices& particles);
  /// Queues a checkpoint, which replaces the existing one after all snapshots queued before it are written.
  Expected<void> write_checkpoint(SimulationState state);
  /// Writes one at once, after what is queued, with these particles in place of the state's.
  Expected<void> write_checkpoint(const SimulationState& state, const ParticleSlices& particles);
  /// Appends a row to series.csv at once. A step that was already written is not written again.
  Expected<void> write_series(const SeriesRow& row);
  Expected<void> write_report(const RunReport& report);

  /// Waits until everything queued is in its file; returns the first error, if any.
  Expected<void> flush();
  /// flush(), syncs to the disk, closes and unlocks the folder. No writes after this.
  Expected<void> finish();

 private:
  struct Impl;
  explicit RunWriter(std::unique_ptr<Impl> impl);
  static std::unique_ptr<Impl> start_files(RunLock lock, const std::filesystem::path& folder, const RunInfo& info,
                                           const std::string& scene_json);
  std::unique_ptr<Impl> impl_;
};

/// Reads the snapshots of a run, finished, running or killed.
class RunReader {
 public:
  /// `run` is a run folder or its particles.vtkhdf. bad_input, with the reason, where it is missing, no run or damaged.
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

  /// Index of the snapshot of this step, or of the one nearest in time (the earlier of two); empty if there is none.
  std::optional<std::size_t> find_step(std::int64_t step) const;
  std::optional<std::size_t> find_time(double seconds) const;

  /// Snapshot `index` < size(), particles by ascending id.
  Expected<Snapshot> read(std::size_t index) const;

 private:
  struct Impl;
  explicit RunReader(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace hooke::io
