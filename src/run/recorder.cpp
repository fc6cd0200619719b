// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>

#include "hooke/render/film.h"
#include "hooke/run/kept_files.h"
#include "hooke/run/numbers.h"

namespace hooke::run {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Whether the checkpoint is the one in the output folder, so that the run continues in that folder.
bool resumes_in_place(const RecordArguments& arguments) {
  std::error_code ignored;
  const std::filesystem::path& checkpoint = arguments.resume;
  const bool is_folder = std::filesystem::is_directory(checkpoint, ignored);
  const std::filesystem::path home = is_folder                      ? checkpoint
                                     : checkpoint.has_parent_path() ? checkpoint.parent_path()
                                                                    : std::filesystem::path(".");
  return !checkpoint.empty() && std::filesystem::equivalent(home, arguments.output, ignored);
}

Expected<io::RunWriter> open_writer(const RecordArguments& arguments, const OpenedSimulation& opened) {
  const Simulation& simulation = opened.simulation;
  const io::RunInfo info = io::describe_run(simulation);
  if (resumes_in_place(arguments)) {
    return io::RunWriter::resume(arguments.output, info, opened.resolved, simulation.step_count(),
                                 simulation.scene().output);
  }
  auto meshes = KeptFiles::copy(opened.files, arguments.output);
  if (!meshes) return fail(std::move(meshes).error());
  auto writer = io::RunWriter::create(arguments.output, info, opened.resolved, {.overwrite = arguments.overwrite});
  if (!writer) return writer;
  if (auto kept = meshes->keep(); !kept) return fail(std::move(kept).error());
  return writer;
}

OutputCadence checkpoint_cadence(const std::optional<double>& seconds, std::int64_t steps) {
  OutputCadence cadence;
  if (seconds) {
    cadence.seconds = *seconds;
  } else {
    cadence.steps = std::max<std::int64_t>(1, (steps + 9) / 10);
  }
  return cadence;
}

}  // namespace

Expected<void> check_record(const RecordArguments& arguments, const std::string& how_to_overwrite) {
  if (!arguments.overwrite && !resumes_in_place(arguments)) {
    const auto taken = io::holds_run(arguments.output);
    if (!taken) return fail(taken.error());
    if (*taken) {
      return fail(Error::Kind::bad_input, arguments.output.string(), "holds a run already; " + how_to_overwrite);
    }
  }
  if (auto free = io::check_not_written(arguments.output); !free) return free;
  if (arguments.film.empty()) return {};
  const PictureArguments& p = arguments.picture;
  return render::check_film(arguments.film, {p.width, p.height, p.frames_per_second});
}

struct Recorder::Impl {
  OpenedSimulation& opened;
  Simulation& simulation;
  io::RunWriter writer;
  std::unique_ptr<FilmThread> film;  // null without a film
  OutputCadence checkpoints;
  RecordEvents events;
  bool in_place;  // the folder holds the output of this run up to the step from which it continues
  std::int64_t first = simulation.step_count();
  std::int64_t last = simulation.scene().steps;
  std::int64_t batch = 1;
  std::int64_t checkpoint_step = -1;  // of the last one written
  double stepping_seconds = 0;

  static constexpr double kBatchSeconds = 0.1;

  bool output_due(std::int64_t step) const {
    return simulation.scene().output.is_due(step, simulation.scene().time_step);
  }
  bool checkpoint_due(std::int64_t step) const { return checkpoints.is_due(step, simulation.scene().time_step); }
  bool frame_due(std::int64_t step) const {
    return film != nullptr && film->is_due(static_cast<double>(step) * simulation.scene().time_step);
  }

  // Steps to the next output, but for at most a fraction of a second, because the watch waits meanwhile.
  Expected<void> advance() {
    const std::int64_t now = simulation.step_count();
    const std::int64_t most = std::min(last, now + batch);
    std::int64_t target = now + 1;
    while (target < most && !output_due(target) && !checkpoint_due(target) && !frame_due(target)) ++target;

    const Clock::time_point start = Clock::now();
    if (auto stepped = simulation.step(target - now); !stepped) return stepped;
    const double seconds = seconds_since(start);
    stepping_seconds += seconds;
    batch = next_batch(target - now, seconds, kBatchSeconds);
    return {};
  }

  // One process goes on while its particles are written. Several ranks hand over theirs a slice at a time, so that
  // rank 0 need not have room for all, and wait meanwhile.
  Expected<void> write_snapshot() {
    if (opened.ranks == 1) return writer.write_snapshot(simulation.snapshot());
    return writer.write_snapshot(simulation.step_count(), simulation.time(), *simulation.slices());
  }
  Expected<void> write_checkpoint() {
    if (opened.ranks == 1) return writer.write_checkpoint(simulation.state());
    return writer.write_checkpoint(simulation.state_besides_particles(), *simulation.slices());
  }

  // Writes the outputs due at this step; at the end of the run, all of them.
  Expected<void> write_outputs(bool at_end) {
    const std::int64_t step = simulation.step_count();
    if (frame_due(step)) film->show(simulation.snapshot());
    const bool must = at_end || (step == first && !in_place);
    if (must || output_due(step)) {
      const auto measurements = simulation.measure();
      if (!measurements) return fail(measurements.error());
      if (auto written = writer.write_series(io::make_series_row(simulation, *measurements)); !written) return written;
      if (auto written = write_snapshot(); !written) return written;
    }
    const bool have_checkpoint = step == checkpoint_step || (step == first && in_place);
    if ((must || checkpoint_due(step)) && !have_checkpoint) {
      if (auto written = write_checkpoint(); !written) return written;
      checkpoint_step = step;
      if (events.checkpoint) events.checkpoint(step);
    }
    return {};
  }
};

Recorder::Recorder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Recorder::~Recorder() = default;
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;

Expected<Recorder> Recorder::start(OpenedSimulation& opened, const RecordArguments& arguments, RecordEvents events) {
  Simulation& simulation = opened.simulation;
  if (simulation.step_count() > simulation.scene().steps) {
    return fail(Error::Kind::bad_input, arguments.resume.string(),
                fmt::format("is of step {}, after the end of the run at step {}", simulation.step_count(),
                            simulation.scene().steps));
  }
  const bool in_place = resumes_in_place(arguments);
  if (in_place && simulation.step_count() != opened.kept_step) {
    return fail(
        Error::Kind::bad_input, arguments.output.string(),
        fmt::format("holds the run up to step {}, from which the simulation was stepped to {}: name another folder",
                    opened.kept_step, simulation.step_count()));
  }
  std::unique_ptr<FilmThread> film;
  if (!arguments.film.empty()) {
    auto started = FilmThread::start(arguments.film, arguments.picture, simulation, events.film_failed);
    if (!started) return fail(std::move(started).error());
    film = std::move(*started);
  }
  auto writer = open_writer(arguments, opened);
  if (!writer) return fail(std::move(writer).error());
  return Recorder(std::make_unique<Impl>(Impl{opened, simulation, std::move(*writer), std::move(film),
                                              checkpoint_cadence(arguments.checkpoint_every, simulation.scene().steps),
                                              std::move(events), in_place}));
}

Expected<bool> Recorder::to_the_end(const Watch& watch) {
  Impl& run = *impl_;
  if (auto written = run.write_outputs(false); !written) return fail(std::move(written).error());
  while (run.simulation.step_count() < run.last &&
         watch(run.simulation.step_count(), run.simulation.particle_count())) {
    if (auto advanced = run.advance(); !advanced) return fail(std::move(advanced).error());
    if (run.simulation.step_count() == run.last) break;  // the last step is written below
    if (auto written = run.write_outputs(false); !written) return fail(std::move(written).error());
  }
  if (auto written = run.write_outputs(true); !written) return fail(std::move(written).error());
  if (auto flushed = run.writer.flush(); !flushed) return fail(std::move(flushed).error());
  if (run.in_place) run.opened.kept_step = run.simulation.step_count();
  return run.simulation.step_count() == run.last;
}

Expected<std::optional<FilmThread::Summary>> Recorder::finish_film() {
  if (!impl_->film) return std::nullopt;
  auto summary = impl_->film->finish();
  if (!summary) return fail(std::move(summary).error());
  return *summary;
}

Expected<io::RunReport> Recorder::finish() {
  Impl& run = *impl_;
  const auto measurements = run.simulation.measure();
  if (!measurements) return fail(measurements.error());
  io::RunReport report = io::make_report(run.simulation, *measurements);
  report.ranks = run.opened.ranks;
  report.threads = run.opened.threads;
  if (report.ranks > 1) report.costs = run.simulation.rank_costs();
  report.steps = run.simulation.step_count() - run.first;
  report.seconds = run.stepping_seconds;
  if (auto written = run.writer.write_report(report); !written) return fail(std::move(written).error());
  if (auto finished = run.writer.finish(); !finished) return fail(std::move(finished).error());
  return report;
}

io::RunWriter& Recorder::writer() { return impl_->writer; }

}  // namespace hooke::run
