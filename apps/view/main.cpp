// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <optional>

#include "hooke/run/output_check.h"
#include "log.h"
#include "replay.h"
#include "session.h"
#include "view_options.h"
#include "viewer.h"
#include "window.h"

namespace hooke::view {
namespace {

using cli::ExitStatus;

ExitStatus replay_headless(const Record& record, const ViewArguments& arguments) {
  const auto end = replay(record, arguments.scene, arguments.device);
  if (!end) return cli::report_error(end.error(), true);
  if (end->report.diverged) {
    fmt::print("DIVERGED at step {}: the state is not that of the record (equal up to step {})\n",
               *end->report.diverged, end->report.last_equal);
    return cli::kRunFailed;
  }
  fmt::print("replayed {} steps with the same bits, {} states compared; state hash {:016x}\n", end->steps,
             end->report.compared, end->state_hash);
  return cli::kDone;
}

ExitStatus show(const ViewArguments& arguments, std::optional<Record> record) {
  // What takes no time is checked before the scene is read.
  if (auto display = Window::check_display(); !display) return cli::report_error(display.error());
  SessionOptions options{arguments.scene, arguments.device, arguments.resume, arguments.record, {}, arguments.paused};
  if (record) options.replay = std::move(record->entries);
  auto session = Session::open(options);
  if (!session) return cli::report_error(session.error());
  for (const Finding& warning : (*session)->warnings()) cli::report_warning(warning);
  const std::string title = "Hooke: " + arguments.scene.file.filename().string();
  auto window = Window::open(title, arguments.width, arguments.height, render::LiveRenderer::kMajor,
                             render::LiveRenderer::kMinor);
  if (!window) return cli::report_error(window.error());
  auto viewer = Viewer::open(**window, **session, {arguments.status});
  if (!viewer) return cli::report_error(viewer.error());
  if (auto shown = (*viewer)->run(); !shown) return cli::report_error(shown.error(), true);
  const std::uint64_t hash = (*session)->finish();
  if (!arguments.record.empty()) fmt::print("recorded {}; state hash {:016x}\n", arguments.record.string(), hash);
  return (*session)->readings().replay.diverged ? cli::kRunFailed : cli::kDone;
}

ExitStatus parse_and_run(int argc, char** argv) {
  ViewArguments arguments;
  CLI::App app("Open a window in which a scene runs and can be touched and tuned; F1 in it shows the keys",
               "hooke view");
  app.set_version_flag("--version", "hooke " HOOKE_VERSION);
  add_view_options(app, arguments);
  try {
    app.parse(argc, argv);
    if (arguments.scene.file.empty() && arguments.replay.empty()) throw CLI::RequiredError("SCENE");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? cli::kDone : cli::kBadInput;
  }
  std::optional<Record> record;
  if (!arguments.replay.empty()) {
    auto read = read_record(arguments.replay);
    if (!read) return cli::report_error(read.error());
    record = std::move(*read);
    if (arguments.scene.file.empty()) {
      arguments.scene = {record->head.scene, record->head.overrides, record->head.allow_outside};
    }
    if (arguments.headless) return replay_headless(*record, arguments);
  }
  if (!arguments.record.empty()) {
    if (auto right = run::check_output_file(arguments.record, "--record"); !right)
      return cli::report_error(right.error());
  }
  return show(arguments, std::move(record));
}

}  // namespace
}  // namespace hooke::view

int main(int argc, char** argv) {
  hooke::cli::start_log(false);
  try {
    return hooke::view::parse_and_run(argc, argv);
  } catch (const std::bad_alloc&) {
    spdlog::error("out of memory");
  } catch (const std::exception& error) {
    spdlog::error("unexpected: {}", error.what());
  }
  return hooke::cli::kRunFailed;
}
