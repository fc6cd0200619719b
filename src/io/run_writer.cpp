// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>
#include <variant>

#include "hooke/base/assert.h"
#include "hooke/io/failure.h"
#include "hooke/io/particles_file.h"
#include "hooke/io/run_folder.h"
#include "hooke/io/run_lock.h"
#include "hooke/io/series_file.h"

namespace hooke::io {

namespace {

namespace fs = std::filesystem;

/// The files of a run, the snapshots first: they mark the folder as a run's.
constexpr const char* kRunFiles[] = {kParticlesFile, kCheckpointFile, kSeriesFile, kSceneFile, kLogFile, kReportFile};

fs::path journal_of(fs::path file) { return file += ".journal"; }

/// All that a run may have left in its folder, the snapshots last: if killed while these are removed in order, the
/// folder still counts as a run.
std::vector<fs::path> removable_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (auto name = std::rbegin(kRunFiles); name != std::rend(kRunFiles); ++name) {
    const fs::path file = folder / *name;
    files.insert(files.end(), {journal_of(file), unfinished_name(file), file});
  }
  return files;
}

void remove_run(const fs::path& folder) {
  for (const fs::path& file : removable_files(folder)) {
    std::error_code error;
    fs::remove(file, error);
    if (error) throw Failure(Error::Kind::io, file, "can't be removed: " + error.message());
  }
}

/// Creates the folder; returns all folders that had to be created, the innermost first.
std::vector<fs::path> make_folder(const fs::path& folder) {
  std::vector<fs::path> made;
  for (fs::path at = fs::absolute(folder).lexically_normal(); !at.empty() && !is_there(at); at = at.parent_path()) {
    made.push_back(at);
    if (at == at.root_path()) break;
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Failure(Error::Kind::io, folder, "can't be made: " + error.message());
  return made;
}

/// Removes those folders as far as they are empty.
void remove_folders(const std::vector<fs::path>& folders) {
  std::error_code ignored;
  for (const fs::path& each : folders) fs::remove(each, ignored);
}

bool is_run(const fs::path& folder) {
  return is_there(folder / kParticlesFile) || is_there(folder / kCheckpointFile) || is_there(folder / kSeriesFile);
}

/// Throws Failure where a new run must not be written into the folder. Returns whether there is a run to replace.
bool check_replaceable(const fs::path& folder, bool overwrite) {
  if (is_there(folder) && !fs::is_directory(folder)) {
    throw Failure(Error::Kind::io, folder, "is a file, not a folder");
  }
  const bool run_there = is_run(folder);
  if (run_there && !overwrite) {
    throw Failure(Error::Kind::bad_input, folder,
                  "holds a run already: name another folder, or say that it is to be overwritten");
  }
  for (const char* name : kRunFiles) {
    if (!run_there && is_there(folder / name)) {
      throw Failure(Error::Kind::bad_input, folder / name,
                    "is there, but its folder holds no run: it would be overwritten; name another folder");
    }
  }
  return run_there;
}

}  // namespace

Expected<bool> holds_run(const fs::path& folder) {
  return guarded(folder, [&] { return is_run(folder); });
}

Expected<void> check_not_written(const fs::path& folder) {
  return guarded(folder, [&] { refuse_if_written(folder); });
}

/// The files of a run and the thread that writes the large ones.
struct RunWriter::Impl {
  using Item = std::variant<std::shared_ptr<const Snapshot>, SimulationState>;

  Impl(RunLock run_lock, fs::path run_folder, RunInfo run_info, ParticlesFile particles_file, SeriesFile series_file)
      : lock(std::move(run_lock)),
        folder(std::move(run_folder)),
        info(std::move(run_info)),
        particles(std::move(particles_file)),
        series(std::move(series_file)),
        last_queued(particles.last_step()),
        thread([this] { work(); }) {}

  ~Impl() { stop(); }

  void work() {
    std::unique_lock held(mutex);
    for (;;) {
      changed.wait(held, [&] { return stopping || !queue.empty(); });
      if (queue.empty()) return;
      busy = true;
      const Item item = std::move(queue.front());
      queue.pop_front();
      changed.notify_all();
      if (!error) {
        held.unlock();
        Expected<void> done = write(item);
        held.lock();
        if (!done) error = std::move(done.error());
      }
      busy = false;
      changed.notify_all();
    }
  }

  Expected<void> write(const Item& item) {
    if (const auto* snapshot = std::get_if<std::shared_ptr<const Snapshot>>(&item)) {
      const Snapshot& s = **snapshot;
      return write_snapshot(s.step, s.time, SlicesOfSet(s.particles));
    }
    const auto& state = std::get<SimulationState>(item);
    return write_checkpoint(state, SlicesOfSet(state.particles));
  }

  Expected<void> write_snapshot(std::int64_t step, double time, const ParticleSlices& slices) {
    return guarded(folder / kParticlesFile, [&] {
      const auto held = hdf5::lock();
      particles.append(step, time, slices);
    });
  }

  // A checkpoint implies that everything before it exists, so it must reach the disk after them.
  Expected<void> write_checkpoint(const SimulationState& state, const ParticleSlices& slices) {
    Expected<void> synced = guarded(folder / kParticlesFile, [&] {
      particles.sync();
      series.sync();
    });
    if (!synced) return synced;
    return io::write_checkpoint(folder / kCheckpointFile, state, slices, info);
  }

  // Writes on the calling thread, when all that was queued before is written.
  template <class Write>
  Expected<void> write_now(const Write& write_it) {
    if (Expected<void> written = wait(); !written) return written;
    if (is_finished()) return is_over();
    Expected<void> done = write_it();
    const std::lock_guard held(mutex);
    if (!done) error = done.error();
    return done;
  }

  // Whether a snapshot of this step is to be written: those of ascending steps are, each once.
  Expected<bool> takes_step(std::int64_t step) {
    if (last_queued && step < *last_queued) {
      return hooke::fail(Error::Kind::bad_input, (folder / kParticlesFile).string(),
                         "snapshots must be written in order of their steps");
    }
    const bool is_new = !last_queued || step > *last_queued;
    last_queued = step;
    return is_new;
  }

  Unexpected is_over() const {
    return hooke::fail(Error::Kind::bad_input, folder.string(), "is finished: nothing more can be written");
  }

  Expected<void> push(Item item) {
    std::unique_lock held(mutex);
    changed.wait(held, [&] { return queue.empty() || error; });
    if (error) return hooke::fail(*error);
    if (stopping) return is_over();
    queue.push_back(std::move(item));
    changed.notify_all();
    return {};
  }

  Expected<void> wait() {
    std::unique_lock held(mutex);
    changed.wait(held, [&] { return queue.empty() && !busy; });
    if (error) return hooke::fail(*error);
    return {};
  }

  bool is_finished() {
    const std::lock_guard held(mutex);
    return stopping;
  }

  void stop() {
    {
      const std::lock_guard held(mutex);
      stopping = true;
    }
    changed.notify_all();
    if (thread.joinable()) thread.join();
  }

  /// Syncs and closes the files and unlocks the folder. Throws Failure. To be called when the thread has stopped.
  void close(bool sync) {
    if (!lock) return;
    const std::optional<RunLock> ends_last = std::exchange(lock, std::nullopt);
    const ParticlesFile closed = std::move(particles);
    if (!sync) return;
    closed.sync();
    series.sync();
  }

  std::optional<RunLock> lock;  // until the files are closed
  fs::path folder;
  RunInfo info;
  ParticlesFile particles;  // used by the thread alone while it runs
  SeriesFile series;
  std::optional<std::int64_t> last_queued;  // step of the last snapshot

  std::mutex mutex;  // guards all members below
  std::condition_variable changed;
  std::deque<Item> queue;  // at most one item waits while another is written
  std::optional<Error> error;
  bool busy = false;
  bool stopping = false;
  std::thread thread;
};

RunWriter::RunWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RunWriter::~RunWriter() = default;
RunWriter::RunWriter(RunWriter&&) noexcept = default;
RunWriter& RunWriter::operator=(RunWriter&&) noexcept = default;

// Makes the files of a new run; where that fails, leaves none of them and throws.
std::unique_ptr<RunWriter::Impl> RunWriter::start_files(RunLock lock, const fs::path& folder, const RunInfo& info,
                                                        const std::string& scene_json) {
  try {
    const auto held = hdf5::lock();
    ParticlesFile particles = ParticlesFile::create(folder / kParticlesFile, info);
    SeriesFile series = SeriesFile::create(folder / kSeriesFile, series_header(info.colliders));
    take(write_text_file(folder / kSceneFile, scene_json));
    return std::make_unique<Impl>(std::move(lock), folder, info, std::move(particles), std::move(series));
  } catch (const std::exception&) {
    std::error_code ignored;
    for (const fs::path& file : removable_files(folder)) fs::remove(file, ignored);
    throw;
  }
}

Expected<RunWriter> RunWriter::create(const fs::path& folder, const RunInfo& info, const std::string& scene_json,
                                      const Options& options) {
  return guarded(folder, [&]() -> RunWriter {
    hdf5::require(folder);
    check_replaceable(folder, options.overwrite);
    const std::vector<fs::path> made = make_folder(folder);
    try {
      RunLock lock(folder);
      if (check_replaceable(folder, options.overwrite)) remove_run(folder);
      return RunWriter(start_files(std::move(lock), folder, info, scene_json));
    } catch (const std::exception&) {
      remove_folders(made);
      throw;
    }
  });
}

Expected<RunWriter> RunWriter::resume(const fs::path& folder, const RunInfo& info, const std::string& scene_json,
                                      std::int64_t step, const OutputCadence& cadence) {
  HOOKE_ASSERT(step >= 0, step);
  return guarded(folder, [&]() -> RunWriter {
    hdf5::require(folder);
    const std::int64_t end_step = cadence.is_due(step, info.time_step) ? step + 1 : step;
    RunLock lock(folder);
    const auto held = hdf5::lock();
    ParticlesFile particles = ParticlesFile::update(folder / kParticlesFile, info, end_step);
    SeriesFile series = SeriesFile::update(folder / kSeriesFile, series_header(info.colliders), end_step);
    take(write_text_file(folder / kSceneFile, scene_json));
    return RunWriter(std::make_unique<Impl>(std::move(lock), folder, info, std::move(particles), std::move(series)));
  });
}

const fs::path& RunWriter::folder() const { return impl_->folder; }
fs::path RunWriter::log_path() const { return impl_->folder / kLogFile; }
fs::path RunWriter::checkpoint_path() const { return impl_->folder / kCheckpointFile; }

Expected<void> RunWriter::write_snapshot(std::shared_ptr<const Snapshot> snapshot) {
  HOOKE_ASSERT(snapshot != nullptr);
  const Expected<bool> is_new = impl_->takes_step(snapshot->step);
  if (!is_new) return fail(is_new.error());
  return *is_new ? impl_->push(std::move(snapshot)) : Expected<void>{};
}

Expected<void> RunWriter::write_snapshot(std::int64_t step, double time, const ParticleSlices& particles) {
  const Expected<bool> is_new = impl_->takes_step(step);
  if (!is_new) return fail(is_new.error());
  if (!*is_new) return {};
  return impl_->write_now([&] { return impl_->write_snapshot(step, time, particles); });
}

Expected<void> RunWriter::write_snapshot(Snapshot snapshot) {
  return write_snapshot(std::make_shared<const Snapshot>(std::move(snapshot)));
}

Expected<void> RunWriter::write_checkpoint(SimulationState state) { return impl_->push(std::move(state)); }

Expected<void> RunWriter::write_checkpoint(const SimulationState& state, const ParticleSlices& particles) {
  return impl_->write_now([&] { return impl_->write_checkpoint(state, particles); });
}

Expected<void> RunWriter::write_series(const SeriesRow& row) {
  HOOKE_ASSERT(!impl_->is_finished(), row.step);
  return guarded(impl_->folder / kSeriesFile, [&] { impl_->series.append(row); });
}

Expected<void> RunWriter::write_report(const RunReport& report) {
  HOOKE_ASSERT(!impl_->is_finished(), report.step);
  return write_text_file(impl_->folder / kReportFile, to_json(report));
}

Expected<void> RunWriter::flush() { return impl_->wait(); }

Expected<void> RunWriter::finish() {
  Expected<void> written = impl_->wait();
  impl_->stop();
  Expected<void> closed = guarded(impl_->folder, [&] { impl_->close(/*sync=*/written.has_value()); });
  return written ? closed : written;
}

}  // namespace hooke::io
