// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <numeric>
#include <optional>
#include <vector>

#include "commands.h"
#include "hooke/io/export.h"
#include "hooke/io/run_folder.h"
#include "hooke/run/kept_scene.h"
#include "hooke/run/output_check.h"
#include "log.h"
#include "run_argument.h"

namespace hooke::cli {
namespace {

// The snapshots that the options select; without options, the last one.
Expected<std::vector<std::size_t>> pick(const io::RunReader& run, const ExportArguments& arguments) {
  if (run.size() == 0) return fail(Error::Kind::bad_input, arguments.run.string(), "holds no snapshot yet");
  if (arguments.all) {
    std::vector<std::size_t> indices(run.size());
    std::iota(indices.begin(), indices.end(), std::size_t{0});
    return indices;
  }
  if (arguments.time) return std::vector{run.find_time(*arguments.time).value_or(0)};
  if (!arguments.step) return std::vector{run.size() - 1};
  if (const auto index = run.find_step(*arguments.step)) return std::vector{*index};
  const std::size_t nearest = run.find_time(static_cast<double>(*arguments.step) * run.info().time_step).value_or(0);
  return fail(Error::Kind::bad_input, "--step",
              fmt::format("there is no snapshot of step {}; they go from step {} to {}, the nearest is {}",
                          *arguments.step, run.steps().front(), run.steps().back(), run.steps()[nearest]));
}

// The scene kept in the run folder; none where `run` is a file or the folder's scene is missing.
Expected<std::optional<Scene>> scene_of(const std::filesystem::path& run) {
  std::error_code ignored;
  if (!std::filesystem::exists(run / io::kSceneFile, ignored)) return std::nullopt;
  auto loaded = run::load_kept_scene(run);
  if (!loaded) return fail(std::move(loaded.error()));
  return std::move(loaded->scene);
}

}  // namespace

ExitStatus export_command(const ExportArguments& arguments) {
  if (auto writable = run::check_output_file(arguments.output, "--output"); !writable)
    return report_error(writable.error());
  if (auto right = check_run_argument(arguments.run, "export"); !right) return report_error(right.error());
  const auto run = io::RunReader::open(arguments.run);
  if (!run) return report_error(run.error());
  const auto indices = pick(*run, arguments);
  if (!indices) return report_error(indices.error());
  const auto scene = scene_of(arguments.run);
  if (!scene) return report_error(scene.error());
  io::ExportOptions options;
  options.content = arguments.content;
  if (const std::optional<Scene>& kept = *scene) options.scene = &*kept;
  options.surface = arguments.surface;
  const auto files = io::export_run(*run, *indices, arguments.output, options);
  if (!files) return report_error(files.error(), true);
  fmt::print("{} snapshot{} in {}\n", indices->size(), indices->size() == 1 ? "" : "s", files->front().string());
  return kDone;
}

}  // namespace hooke::cli
