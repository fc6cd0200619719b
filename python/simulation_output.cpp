// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Pictures of a simulation, and its run into a folder.
#include <fmt/format.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>

#include "hooke/run/output_check.h"
#include "hooke/run/recorder.h"
#include "picture_arguments.h"
#include "simulation.h"

namespace hooke::python {
namespace {

void check_limits(const char* name, double value, const run::Limits& limits) {
  if (value >= limits.least && value <= limits.most) return;
  raise_input(name, fmt::format("{} must be {} to {}", value, limits.least, limits.most));
}

}  // namespace

py::array PythonSimulation::render(std::pair<int, int> size, const std::string& color_by,
                                   const std::optional<std::array<double, 2>>& range, int samples, bool legend,
                                   bool alpha) {
  const auto arguments = to_picture_arguments(size, color_by, range, samples, legend, alpha);
  const Simulation& simulation = use();
  auto image = without_gil([&] {
    const auto now = simulation.snapshot();
    return pictures_.picture(arguments, simulation.scene(), now->particles, nullptr, now->particles, now->time);
  });
  return to_array(unwrap(std::move(image)), alpha);
}

py::object PythonSimulation::png() {
  if (is_closed() || is_busy()) return py::none();
  const Simulation& simulation = use();
  run::PictureArguments arguments;
  arguments.width = 640;
  arguments.height = 360;
  const auto bytes = without_gil([&]() -> Expected<std::string> {
    const auto now = simulation.snapshot();
    const auto image =
        pictures_.picture(arguments, simulation.scene(), now->particles, nullptr, now->particles, now->time);
    if (!image) return fail(image.error());
    return render::encode_png(*image);
  });
  if (!bytes) return py::none();
  return py::bytes(*bytes);
}

void PythonSimulation::run(const RunOptions& options) {
  use();  // refuses where it is closed or at work
  if (is_stepping()) raise(ErrorClass::busy, {{"simulation", "is in a step already"}});
  if (!force_function_.is_none()) {
    raise_input("external_forces", "is a function, which run() does not call: step() and write what you need");
  }
  if (!options.on_progress.is_none() && PyCallable_Check(options.on_progress.ptr()) == 0) {
    raise_input("on_progress", "expected a function of step and particles, or None");
  }
  check_limits("fps", options.frames_per_second, run::kFramesPerSecond);
  check_limits("speed", options.speed, run::kFilmSpeed);
  if (const double seconds = options.checkpoint_every.value_or(1); !(std::isfinite(seconds) && seconds > 0)) {
    raise_input("checkpoint_every", fmt::format("{} must be above 0", seconds));
  }
  run::RecordArguments record;
  record.output = options.folder;
  record.overwrite = options.overwrite;
  record.resume = resume_;
  record.checkpoint_every = options.checkpoint_every;
  record.film = options.film.value_or("");
  record.picture = to_picture_arguments(options.size, options.color_by, {}, 2, true, false);
  record.picture.frames_per_second = options.frames_per_second;
  record.picture.speed = options.speed;
  unwrap(run::check_record(record, "overwrite=True replaces it"));
  if (options.film) unwrap(run::check_output_file(*options.film, "film"));

  const ThreadMark stepping(stepper_);
  // Python is asked several times a second: for signals, and by the caller's function.
  bool raised = false;
  const auto watch = [&](std::int64_t step, std::uint64_t particles) {
    const py::gil_scoped_acquire python;
    working_ = false;
    try {
      if (!options.on_progress.is_none()) options.on_progress(step, particles);
      raised = PyErr_CheckSignals() != 0;
    } catch (py::error_already_set& error) {
      error.restore();
      raised = true;
    }
    working_ = true;
    return !raised;
  };
  // The exception of `watch` stays set in this thread while the run is ended in good order.
  auto done = without_gil([&]() -> Expected<void> {
    auto recorder = run::Recorder::start(*opened_, record);
    if (!recorder) return fail(std::move(recorder).error());
    if (auto ended = recorder->to_the_end(watch); !ended) return fail(std::move(ended).error());
    const auto film = recorder->finish_film();
    if (auto finished = recorder->finish(); !finished) return fail(std::move(finished).error());
    if (!film) return fail(film.error());
    return {};
  });
  if (raised) throw py::error_already_set();
  unwrap(std::move(done));
}

}  // namespace hooke::python
