// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <utility>

#include "commands.h"
#include "hooke/base/printable.h"
#include "hooke/io/describe_file.h"
#include "hooke/io/run_folder.h"
#include "hooke/run/numbers.h"
#include "hooke/run/open_simulation.h"
#include "hooke/run/output_check.h"
#include "hooke/run/start_checks.h"
#include "interrupt.h"
#include "log.h"
#include "progress.h"

namespace hooke::cli {
namespace {

void log_start(const run::OpenedSimulation& opened) {
  const Simulation& simulation = opened.simulation;
  const BackendInfo back_end = simulation.backend_info();
  spdlog::info("hooke {}: {}, {} particles, step {} to {} of {} s, {} ({}), {} precision, {}", HOOKE_VERSION,
               printable(simulation.scene().name), simulation.particle_count(), simulation.step_count(),
               simulation.scene().steps, simulation.scene().time_step, back_end.device, back_end.isa,
               to_string(back_end.precision), run::ranks_and_threads(opened.ranks, opened.threads));
  for (const Finding& warning : opened.warnings) report_warning(warning);
  if (const std::string small = run::small_ranks(opened); !small.empty()) spdlog::warn(small);
  if (simulation.step_count() == 0) {
    for (const std::string& sentence : run::overlapped_bodies(simulation)) spdlog::info(sentence);
  }
  for (const Finding& finding : run::deep_starts(simulation)) report_warning(finding);
  if (const std::string unstable = run::unstable_step(simulation); !unstable.empty()) spdlog::warn(unstable);
  if (const std::string coarse = run::coarse_positions(simulation); !coarse.empty()) spdlog::warn(coarse);
}

void print_summary(const io::RunReport& report, const io::RunWriter& writer) {
  const Measurements& m = report.measurements;
  fmt::print("{} particles, {} steps in {} ({:.1f} steps/s, {:.2f} M particle-steps/s), t = {:.6g} s\n",
             run::with_commas(report.particles), report.steps, run::clock_time(report.seconds),
             report.steps_per_second(), report.particle_steps_per_second() * 1e-6, report.time);
  fmt::print("kinetic energy {:.6g} J, fastest {:.3g} m/s, deepest overlap {:.3g} %, removed {}, state {:016x}\n",
             m.kinetic_energy, m.max_speed, 100 * m.max_overlap_ratio, report.ledger.removed, report.state_hash);
  fmt::print("written to {}\n", writer.folder().string());
}

// Whether the film is complete, if there is one; if not, the error has been reported.
bool finish_film(run::Recorder& recorder, const RunArguments& arguments) {
  const auto finished = recorder.finish_film();
  if (!finished) return false;
  const auto& summary = *finished;
  if (!summary) return true;
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

// What can be refused before the scene is read.
Expected<void> check_arguments(const RunArguments& arguments) {
  const char* const how = "--overwrite replaces it, -o DIR names another folder";
  if (auto ready = run::check_record(arguments, how); !ready) return ready;
  for (const auto& [file, option] : {std::pair{arguments.report, "--report"}, {arguments.film, "--film"}}) {
    if (file.empty()) continue;
    if (auto writable = run::check_output_file(file, option); !writable) return writable;
  }
  return {};
}

// Steps to the end, or until a signal comes; returns whether the end was reached.
Expected<bool> run_to_the_end(run::Recorder& recorder, const Simulation& simulation, bool quiet) {
  const Interrupt interrupt;
  Progress progress(simulation.step_count(), simulation.scene().steps, simulation.scene().time_step, !quiet);
  const auto complete = recorder.to_the_end([&](std::int64_t step, std::uint64_t particles) {
    progress.update(step, particles);
    return !interrupt.requested();
  });
  progress.clear();
  return complete;
}

}  // namespace

ExitStatus run_command(const RunArguments& given, const run::LaunchedRanks& ranks) {
  RunArguments arguments = given;
  if (arguments.output.empty()) arguments.output = arguments.scene.file.stem();
  if (auto right = check_arguments(arguments); !right) return report_error(right.error());
  auto opened = run::open_simulation(arguments.scene, arguments.device, arguments.resume, ranks);
  if (!opened) return report_error(opened.error());
  const Simulation& simulation = opened->simulation;
  run::RecordEvents events;
  events.film_failed = [](const Error& why) { spdlog::error("the film ends here: {}", printable(why.text(), 1000)); };
  events.checkpoint = [](std::int64_t step) { spdlog::info("checkpoint of step {}", step); };
  auto recorder = run::Recorder::start(*opened, arguments, std::move(events));
  if (!recorder) return report_error(recorder.error());
  io::RunWriter& writer = recorder->writer();
  if (auto logging = log_to_file(writer.log_path()); !logging) return report_error(logging.error(), true);
  log_start(*opened);

  const auto complete = run_to_the_end(*recorder, simulation, arguments.quiet);
  const bool film_good = finish_film(*recorder, arguments);
  if (!complete) return report_failure(complete.error(), writer);
  const auto report = recorder->finish();
  if (!report) return report_failure(report.error(), writer);
  if (!arguments.report.empty()) {
    if (auto written = io::write_text_file(arguments.report, io::to_json(*report)); !written) {
      return report_failure(written.error(), writer);
    }
  }
  const std::string soft = run::soft_particles(simulation, report->measurements);
  if (!soft.empty()) spdlog::warn(soft);

  spdlog::info("{} at step {}, {:.1f} steps/s, state {:016x}", *complete ? "done" : "interrupted", report->step,
               report->steps_per_second(), report->state_hash);
  if (!*complete) {
    spdlog::warn("interrupted at step {} of {}; go on with --resume {}", report->step, simulation.scene().steps,
                 writer.checkpoint_path().string());
    return kInterrupted;
  }
  if (!arguments.quiet) print_summary(*report, writer);
  return film_good ? kDone : kRunFailed;
}

}  // namespace hooke::cli
