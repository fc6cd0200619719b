// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <system_error>
#include <utility>

#include "commands.h"
#include "film_thread.h"
#include "hooke/base/printable.h"
#include "hooke/io/describe_file.h"
#include "hooke/io/run_folder.h"
#include "hooke/render/film.h"
#include "interrupt.h"
#include "log.h"
#include "numbers.h"
#include "open_simulation.h"
#include "output_file.h"
#include "progress.h"

namespace hooke::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Steps a simulation to its end and writes its folder meanwhile.
class Run {
 public:
  /// `in_place`: the folder holds the output of this run up to the step from which it continues.
  /// `film`: the film's thread, or null without a film.
  Run(Simulation& simulation, io::RunWriter& writer, FilmThread* film, const OutputCadence& checkpoints, bool in_place,
      bool quiet)
      : simulation_(simulation),
        writer_(writer),
        film_(film),
        checkpoints_(checkpoints),
        new_folder_(!in_place),
        first_(simulation.step_count()),
        last_(simulation.scene().steps),
        progress_(first_, last_, simulation.scene().time_step, !quiet) {}

  /// True if the run reached its end, false if a signal came first; either way a snapshot and a checkpoint of the last
  /// step exist.
  Expected<bool> to_the_end() {
    const Interrupt interrupt;
    if (auto written = write_outputs(false); !written) return fail(std::move(written).error());
    while (simulation_.step_count() < last_ && !interrupt.requested()) {
      if (auto advanced = advance(); !advanced) return fail(std::move(advanced).error());
    }
    progress_.clear();
    if (auto written = write_outputs(true); !written) return fail(std::move(written).error());
    if (auto flushed = writer_.flush(); !flushed) return fail(std::move(flushed).error());
    return simulation_.step_count() == last_;
  }

  std::int64_t steps_taken() const { return simulation_.step_count() - first_; }
  double stepping_seconds() const { return stepping_seconds_; }

 private:
  bool output_due(std::int64_t step) const {
    return simulation_.scene().output.is_due(step, simulation_.scene().time_step);
  }
  bool checkpoint_due(std::int64_t step) const { return checkpoints_.is_due(step, simulation_.scene().time_step); }
  bool frame_due(std::int64_t step) const {
    return film_ != nullptr && film_->is_due(static_cast<double>(step) * simulation_.scene().time_step);
  }

  // Steps to the next output, but for at most a fraction of a second, because signals and progress wait meanwhile.
  Expected<void> advance() {
    const std::int64_t now = simulation_.step_count();
    const std::int64_t most = std::min(last_, now + batch_);
    std::int64_t target = now + 1;
    while (target < most && !output_due(target) && !checkpoint_due(target) && !frame_due(target)) ++target;

    const Clock::time_point start = Clock::now();
    if (auto stepped = simulation_.step(target - now); !stepped) return stepped;
    const double seconds = seconds_since(start);
    stepping_seconds_ += seconds;
    const double a_step = seconds / static_cast<double>(target - now);
    batch_ = static_cast<std::int64_t>(std::clamp(kBatchSeconds / std::max(a_step, 1e-9), 1.0, 1e6));

    progress_.update(target, simulation_.particle_count());
    if (target == last_) return {};  // to_the_end() writes the last step
    return write_outputs(false);
  }

  // Writes the outputs due at this step; at the end of the run, all of them.
  Expected<void> write_outputs(bool at_end) {
    const std::int64_t step = simulation_.step_count();
    if (frame_due(step)) film_->show(simulation_.snapshot());
    const bool must = at_end || (step == first_ && new_folder_);
    if (must || output_due(step)) {
      const auto measurements = simulation_.measure();
      if (!measurements) return fail(measurements.error());
      if (auto written = writer_.write_series(io::make_series_row(simulation_, *measurements)); !written)
        return written;
      if (auto written = writer_.write_snapshot(simulation_.snapshot()); !written) return written;
    }
    const bool have_checkpoint = step == checkpoint_step_ || (step == first_ && !new_folder_);
    if ((must || checkpoint_due(step)) && !have_checkpoint) {
      if (auto written = writer_.write_checkpoint(simulation_.state()); !written) return written;
      spdlog::info("checkpoint of step {}", step);
      checkpoint_step_ = step;
    }
    return {};
  }

  static constexpr double kBatchSeconds = 0.1;

  Simulation& simulation_;
  io::RunWriter& writer_;
  FilmThread* film_;
  OutputCadence checkpoints_;
  bool new_folder_;
  std::int64_t first_;
  std::int64_t last_;
  std::int64_t batch_ = 1;
  std::int64_t checkpoint_step_ = -1;  // of the last one written
  double stepping_seconds_ = 0;
  Progress progress_;
};

// Ten checkpoints per run, unless told otherwise.
OutputCadence checkpoint_cadence(const std::optional<double>& seconds, std::int64_t steps) {
  OutputCadence cadence;
  if (seconds) {
    cadence.seconds = *seconds;
  } else {
    cadence.steps = std::max<std::int64_t>(1, (steps + 9) / 10);
  }
  return cadence;
}

std::filesystem::path output_folder(const RunArguments& arguments) {
  return arguments.output.empty() ? arguments.scene.file.stem() : arguments.output;
}

// Whether the checkpoint is the one in the output folder, so that the run continues in that folder.
bool resumes_in_place(const RunArguments& arguments) {
  std::error_code ignored;
  const std::filesystem::path& checkpoint = arguments.resume;
  const bool is_folder = std::filesystem::is_directory(checkpoint, ignored);
  const std::filesystem::path home = is_folder                      ? checkpoint
                                     : checkpoint.has_parent_path() ? checkpoint.parent_path()
                                                                    : std::filesystem::path(".");
  return !checkpoint.empty() && std::filesystem::equivalent(home, output_folder(arguments), ignored);
}

// Whether the run may write its folder: nothing else is begun, a film least of all, where it may not.
Expected<void> check_folder(const RunArguments& arguments) {
  const std::filesystem::path folder = output_folder(arguments);
  if (!arguments.overwrite && !resumes_in_place(arguments)) {
    const auto taken = io::holds_run(folder);
    if (!taken) return fail(taken.error());
    if (*taken) {
      return fail(Error::Kind::bad_input, folder.string(),
                  "holds a run already; --overwrite replaces it, -o DIR names another folder");
    }
  }
  return io::check_not_written(folder);
}

// Copies the meshes that the scene names into the run folder, beside its scene, so that the folder can be drawn
// anywhere. Meshes named by an absolute path or with ".." are not copied.
Expected<void> keep_files(const std::vector<scene::SceneFile>& files, const std::filesystem::path& folder) {
  for (const scene::SceneFile& file : files) {
    const std::filesystem::path name(file.name), kept = folder / name;
    const bool inside = name.is_relative() && std::find(name.begin(), name.end(), "..") == name.end();
    std::error_code fault;
    if (!inside || std::filesystem::equivalent(file.path, kept, fault)) continue;
    std::filesystem::create_directories(kept.parent_path(), fault);
    std::filesystem::copy_file(file.path, kept, std::filesystem::copy_options::overwrite_existing, fault);
    if (fault) return fail(Error::Kind::io, kept.string(), "can't be written: " + fault.message());
  }
  return {};
}

Expected<io::RunWriter> open_writer(const RunArguments& arguments, const OpenedSimulation& opened) {
  const Simulation& simulation = opened.simulation;
  const io::RunInfo info = io::describe_run(simulation);
  if (resumes_in_place(arguments)) {
    return io::RunWriter::resume(output_folder(arguments), info, opened.resolved, simulation.step_count(),
                                 simulation.scene().output);
  }
  auto writer =
      io::RunWriter::create(output_folder(arguments), info, opened.resolved, {.overwrite = arguments.overwrite});
  if (!writer) return writer;
  if (auto kept = keep_files(opened.files, output_folder(arguments)); !kept) return fail(std::move(kept).error());
  return writer;
}

void log_start(const OpenedSimulation& opened) {
  const Simulation& simulation = opened.simulation;
  const BackendInfo back_end = simulation.backend_info();
  spdlog::info("hooke {}: {}, {} particles, step {} to {} of {} s, {} ({}), {} precision, {} threads", HOOKE_VERSION,
               printable(simulation.scene().name), simulation.particle_count(), simulation.step_count(),
               simulation.scene().steps, simulation.scene().time_step, back_end.device, back_end.isa,
               to_string(back_end.precision), back_end.threads);
  for (const Finding& warning : opened.warnings) report_warning(warning);
  if (simulation.step_count() == 0) {
    for (const std::string& sentence : overlapped_bodies(simulation)) spdlog::info(sentence);
  }
  for (const Finding& finding : deep_starts(simulation)) report_warning(finding);
  if (const std::string unstable = unstable_step(simulation); !unstable.empty()) spdlog::warn(unstable);
  if (const std::string coarse = coarse_positions(simulation); !coarse.empty()) spdlog::warn(coarse);
}

Expected<io::RunReport> write_reports(const Run& run, const Simulation& simulation, io::RunWriter& writer,
                                      const RunArguments& arguments) {
  const auto measurements = simulation.measure();
  if (!measurements) return fail(measurements.error());
  io::RunReport report = io::make_report(simulation, *measurements);
  report.steps = run.steps_taken();
  report.seconds = run.stepping_seconds();
  if (auto written = writer.write_report(report); !written) return fail(std::move(written).error());
  if (!arguments.report.empty()) {
    if (auto written = io::write_text_file(arguments.report, io::to_json(report)); !written) {
      return fail(std::move(written).error());
    }
  }
  if (auto finished = writer.finish(); !finished) return fail(std::move(finished).error());
  return report;
}

void print_summary(const io::RunReport& report, const io::RunWriter& writer) {
  const Measurements& m = report.measurements;
  fmt::print("{} particles, {} steps in {} ({:.1f} steps/s, {:.2f} M particle-steps/s), t = {:.6g} s\n",
             with_commas(report.particles), report.steps, clock_time(report.seconds), report.steps_per_second(),
             report.particle_steps_per_second() * 1e-6, report.time);
  fmt::print("kinetic energy {:.6g} J, fastest {:.3g} m/s, deepest overlap {:.3g} %, removed {}, state {:016x}\n",
             m.kinetic_energy, m.max_speed, 100 * m.max_overlap_ratio, report.ledger.removed, report.state_hash);
  fmt::print("written to {}\n", writer.folder().string());
}

// Whether the film is complete; if not, the error has been reported.
bool finish_film(FilmThread& film, const RunArguments& arguments) {
  const auto summary = film.finish();
  if (!summary) return false;
  const double length = static_cast<double>(summary->frames) / arguments.picture.frames_per_second;
  spdlog::info("film of {} frames, {:.2f} s each to draw: {}", summary->frames, summary->seconds_a_frame,
               arguments.film.string());
  if (!arguments.quiet) {
    fmt::print("film of {} frames, {:.2f} s, {:.2f} s each to draw, in {}\n", summary->frames, length,
               summary->seconds_a_frame, arguments.film.string());
  }
  return true;
}

// A failed run keeps its last good state; reports which.
ExitStatus report_failure(const Error& error, io::RunWriter& writer) {
  const ExitStatus status = report_error(error, true);
  (void)writer.flush();  // fails where `error` says so; either way the file is now final
  if (const auto checkpoint = io::describe_file(writer.checkpoint_path())) {
    spdlog::error("the last good checkpoint is of step {}: {}", checkpoint->steps.front(),
                  writer.checkpoint_path().string());
  }
  return status;
}

}  // namespace

ExitStatus run_command(const RunArguments& arguments) {
  if (auto ready = check_folder(arguments); !ready) return report_error(ready.error());
  if (!arguments.report.empty()) {
    if (auto writable = check_output_file(arguments.report, "--report"); !writable) {
      return report_error(writable.error());
    }
  }
  if (!arguments.film.empty()) {
    const PictureArguments& p = arguments.picture;
    if (auto possible = render::check_film(arguments.film, {p.width, p.height, p.frames_per_second}); !possible) {
      return report_error(possible.error());
    }
    if (auto writable = check_output_file(arguments.film, "--film"); !writable) return report_error(writable.error());
  }
  auto opened = open_simulation(arguments.scene, arguments.device, arguments.resume);
  if (!opened) return report_error(opened.error());
  Simulation& simulation = opened->simulation;
  if (simulation.step_count() > simulation.scene().steps) {
    return report_error(
        {Error::Kind::bad_input,
         {{arguments.resume.string(), fmt::format("is of step {}, after the end of the run at step {}",
                                                  simulation.step_count(), simulation.scene().steps)}}});
  }
  std::unique_ptr<FilmThread> film;
  if (!arguments.film.empty()) {
    auto started = FilmThread::start(arguments.film, arguments.picture, simulation);
    if (!started) return report_error(started.error());
    film = std::move(*started);
  }
  auto writer = open_writer(arguments, *opened);
  if (!writer) return report_error(writer.error());
  if (auto logging = log_to_file(writer->log_path()); !logging) return report_error(logging.error(), true);
  log_start(*opened);

  Run run(simulation, *writer, film.get(), checkpoint_cadence(arguments.checkpoint_every, simulation.scene().steps),
          resumes_in_place(arguments), arguments.quiet);
  const auto complete = run.to_the_end();
  const bool film_good = film == nullptr || finish_film(*film, arguments);
  if (!complete) return report_failure(complete.error(), *writer);
  const auto report = write_reports(run, simulation, *writer, arguments);
  if (!report) return report_failure(report.error(), *writer);
  if (const std::string soft = soft_particles(simulation, report->measurements); !soft.empty()) spdlog::warn(soft);

  spdlog::info("{} at step {}, {:.1f} steps/s, state {:016x}", *complete ? "done" : "interrupted", report->step,
               report->steps_per_second(), report->state_hash);
  if (!*complete) {
    spdlog::warn("interrupted at step {} of {}; go on with --resume {}", report->step, simulation.scene().steps,
                 writer->checkpoint_path().string());
    return kInterrupted;
  }
  if (!arguments.quiet) print_summary(*report, *writer);
  return film_good ? kDone : kRunFailed;
}

}  // namespace hooke::cli
