// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <map>
#include <new>

#include "commands.h"
#include "hooke/render/film.h"
#include "log.h"
#include "scene_options.h"

namespace hooke::cli {
namespace {

/// The arguments of the command line; the chosen command sets `command`.
struct CommandLine {
  RunArguments run;
  CheckArguments check;
  BenchArguments bench;
  RenderArguments render;
  ExportArguments exports;
  std::filesystem::path info;
  std::optional<std::int64_t> steps;
  std::optional<double> end;
  std::function<ExitStatus()> command;
};

// Parses "1280x720" into width and height.
std::string parse_size(const std::string& text, PictureArguments& picture) {
  int width = 0, height = 0;
  char rest = 0;
  constexpr int kMost = 16384;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 1 || height < 1 || width > kMost ||
      height > kMost) {
    return fmt::format("{} is no size such as 1280x720, from 1x1 to {}x{}", text, kMost, kMost);
  }
  picture.width = width;
  picture.height = height;
  return {};
}

// CLI::Range accepts NaN.
std::string not_nan(const std::string& text) {
  return std::isnan(std::strtod(text.c_str(), nullptr)) ? text + " is no number" : "";
}

void add_picture_options(CLI::App& command, PictureArguments& picture) {
  command
      .add_option_function<std::string>(
          "--size", [](const std::string&) {}, "of the picture, pixels (default: 1280x720)")
      ->option_text("WxH")
      ->check([&picture](const std::string& text) { return parse_size(text, picture); });
  command.add_option("--fps", picture.frames_per_second, "frames a second of film (default: 30)")
      ->option_text("F")
      ->check(CLI::Range(1e-3, 1000.0) & CLI::Validator(not_nan, ""));
  command
      .add_option("--speed", picture.speed,
                  "simulated seconds that a second of film shows: 0.25 is slow motion (default: 1)")
      ->option_text("X")
      ->check(CLI::Range(1e-6, 1e6) & CLI::Validator(not_nan, ""));
  std::map<std::string, render::ColorBy> names;
  for (const render::ColorByName& name : render::kColorByNames) names[name.name] = name.by;
  command
      .add_option("--color-by", picture.color_by,
                  "material (default), speed, height, pressure, contacts or id; all but material with a legend")
      ->option_text("WHAT")
      ->transform(CLI::CheckedTransformer(names));
  command
      .add_option_function<std::vector<double>>(
          "--color-range",
          [&picture](const std::vector<double>& ends) {
            if (!(ends[0] < ends[1]) || !std::isfinite(ends[1] - ends[0])) {
              throw CLI::ValidationError("--color-range", "LOW must be below HIGH");
            }
            picture.range = {ends[0], ends[1]};
          },
          "values at the two ends of the colours (default: from the scene)")
      ->option_text("LOW HIGH")
      ->expected(2);
  command.add_option("--samples", picture.samples, "samples a pixel, along each side (default: 2)")
      ->option_text("N")
      ->check(CLI::Range(1, 4));
  command.add_flag("!--no-legend", picture.legend, "leave out the time and the legend");
}

void add_run(CLI::App& app, CommandLine& line) {
  CLI::App& command =
      *app.add_subcommand("run", "run a scene and write a folder with its snapshots, series and checkpoint");
  RunArguments& run = line.run;
  add_scene_options(command, run.scene);
  command.add_option("-o,--output", run.output, "folder to write (default: named after the scene file)")
      ->option_text("DIR");
  command.add_flag("--overwrite", run.overwrite, "replace the run that the folder holds");
  CLI::Option* steps =
      command.add_option("--steps", line.steps, "end after this many steps from the start of the simulation")
          ->option_text("N")
          ->check(CLI::NonNegativeNumber);
  command.add_option("--end", line.end, "end at this time, in simulated seconds")
      ->option_text("T")
      ->check(CLI::NonNegativeNumber)
      ->excludes(steps);
  add_device_options(command, run.device);
  command.add_option("--resume", run.resume, "go on from a checkpoint; into its own folder, appends")
      ->option_text("CHECKPOINT");
  command
      .add_option("--checkpoint-every", run.checkpoint_every,
                  "simulated seconds between checkpoints (default: ten a run)")
      ->option_text("T")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--film", run.film,
                  fmt::format("draw a film while it runs, into this file ({})", render::film_extensions()))
      ->option_text("FILE");
  add_picture_options(command, run.picture);
  command.add_option("--report", run.report, "write the report to this file too")->option_text("FILE");
  command.add_flag("-q,--quiet", run.quiet, "print nothing but errors");
  command.callback([&line] {
    // As overrides they are checked and written into the resolved scene like any other value.
    if (line.steps) line.run.scene.overrides.push_back(fmt::format("time.steps={}", *line.steps));
    if (line.end) line.run.scene.overrides.push_back(fmt::format("time.end={}", *line.end));
    line.command = [&line] {
      start_log(line.run.quiet);
      return run_command(line.run);
    };
  });
}

void add_check(CLI::App& app, CommandLine& line) {
  CLI::App& command =
      *app.add_subcommand("check", "validate a scene; its size, step against stability, overlaps at the start");
  add_scene_options(command, line.check.scene);
  command.add_flag("--strict", line.check.strict, "exit with status 2 where the step is unstable");
  command.callback([&line] { line.command = [&line] { return check_command(line.check); }; });
}

void add_bench(CLI::App& app, CommandLine& line) {
  CLI::App& command =
      *app.add_subcommand("bench", "time a scene's steps; prints a speed only if the physics was right");
  BenchArguments& bench = line.bench;
  add_scene_options(command, bench.scene);
  command.add_option("--steps", bench.steps, "steps to time")
      ->option_text("N")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command.add_option("--warmup", bench.warmup, "steps before them")
      ->option_text("N")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command.add_option("--resume", bench.resume, "start from a checkpoint of the scene")->option_text("CHECKPOINT");
  add_device_options(command, bench.device);
  command.add_flag("--json", bench.json, "print one JSON object");
  command.callback([&line] { line.command = [&line] { return bench_command(line.bench); }; });
}

void add_render(CLI::App& app, CommandLine& line) {
  CLI::App& command = *app.add_subcommand("render", "draw a picture or a film of a run");
  RenderArguments& render = line.render;
  command.add_option("RUN", render.run, "run folder")->required();
  command
      .add_option(
          "-o,--output", render.output,
          fmt::format("picture (.png), numbered pictures (frame_%04d.png) or film ({})", render::film_extensions()))
      ->option_text("FILE")
      ->required();
  command.add_option("--time", render.time, "of a picture, s, between two snapshots too (default: the last snapshot)")
      ->option_text("T");
  command.add_option("--from", render.from, "where a film starts, s (default: the first snapshot)")->option_text("T");
  command.add_option("--to", render.to, "where a film ends, s (default: the last snapshot)")->option_text("T");
  add_picture_options(command, render.picture);
  command.add_option("--every", render.every, "a frame for every N-th snapshot, as it was written, instead of by time")
      ->option_text("N")
      ->check(CLI::PositiveNumber)
      ->excludes("--speed");
  command.add_flag("--alpha", render.picture.alpha, "pictures (.png) with alpha, without ground, sky and legend");
  command
      .add_option("--set", render.overrides,
                  "replace a value of the run's scene, e.g. camera.orbit=5 or picture.box=false; may be repeated")
      ->option_text("PATH=VALUE")
      ->allow_extra_args(false);
  command.callback([&line] { line.command = [&line] { return render_command(line.render); }; });
}

constexpr io::ExportContent kContents[] = {io::ExportContent::particles, io::ExportContent::surface,
                                           io::ExportContent::volume,    io::ExportContent::contacts,
                                           io::ExportContent::cloths,    io::ExportContent::springs};

// The formats that `export` can write, by content.
std::string format_list() {
  std::string list = "Formats:\n";
  for (const io::ExportContent content : kContents) {
    std::string lines;
    for (const io::ExportFormatInfo& format : io::export_formats()) {
      if (format.content == content) lines += fmt::format("    {:<12}{}\n", format.extension, format.description);
    }
    if (!lines.empty()) list += fmt::format("  --as {}\n{}", to_string(content), lines);
  }
  return list;
}

void add_export(CLI::App& app, CommandLine& line) {
  CLI::App& command =
      *app.add_subcommand("export", "write snapshots of a run in another format, by the file's extension");
  ExportArguments& exports = line.exports;
  command.add_option("RUN", exports.run, "run folder")->required();
  command.add_option("-o,--output", exports.output, "file to write; its extension names the format")
      ->option_text("FILE")
      ->required();
  CLI::Option* step =
      command.add_option("--step", exports.step, "the snapshot of this step (default: the last)")->option_text("N");
  CLI::Option* time = command.add_option("--time", exports.time, "the snapshot nearest to this time, s")
                          ->option_text("T")
                          ->excludes(step);
  command.add_flag("--all", exports.all, "all snapshots")->excludes(step)->excludes(time);
  std::map<std::string, io::ExportContent> contents;
  for (const io::ExportContent content : kContents) contents[to_string(content)] = content;
  command
      .add_option("--as", exports.content,
                  "what to write: particles (default), surface, volume, contacts, cloths or springs")
      ->option_text("CONTENT")
      ->transform(CLI::CheckedTransformer(contents));
  const auto add_surface_option = [&command](const char* name, double& value, const char* description) {
    return command.add_option(name, value, fmt::format("{} (default: {})", description, value))->option_text("R");
  };
  volumes::SurfaceOptions& surface = exports.surface;
  add_surface_option("--surface-radius", surface.radius, "of the sphere that a particle stands for, in its own radii");
  add_surface_option("--surface-smoothing", surface.smoothing,
                     "how far beyond it a particle blends with others, in its own radii");
  add_surface_option("--surface-resolution", surface.resolution, "edge of a voxel, in radii of the smallest particle");
  command.footer(format_list);
  command.callback([&line] { line.command = [&line] { return export_command(line.exports); }; });
}

void add_others(CLI::App& app, CommandLine& line) {
  CLI::App& info = *app.add_subcommand("info", "say what a run folder, snapshot file or checkpoint holds");
  info.add_option("FILE", line.info, "run folder or file of one")->required();
  info.callback([&line] { line.command = [&line] { return info_command(line.info); }; });
  app.add_subcommand("scenes", "list the scenes that come with Hooke")->callback([&line] {
    line.command = scenes_command;
  });
  app.add_subcommand("schema", "print the JSON Schema of scene files")->callback([&line] {
    line.command = schema_command;
  });
}

// The window is a program of its own, which knows its options.
void add_view(CLI::App& app, CommandLine& line) {
  CLI::App& command = *app.add_subcommand("view", "open a window in which a scene runs and can be touched and tuned");
  command.prefix_command();
  command.set_help_flag();
  command.callback([&] { line.command = [&command] { return view_command(command.remaining()); }; });
}

ExitStatus parse_and_run(int argc, char** argv) {
  CommandLine line;
  CLI::App app("Hooke, a real-time spring-mass particle engine", "hooke");
  app.set_version_flag("--version", "hooke " HOOKE_VERSION);
  app.require_subcommand(0, 1);
  add_run(app, line);
  add_check(app, line);
  add_bench(app, line);
  add_render(app, line);
  add_export(app, line);
  add_view(app, line);
  add_others(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Help and the version arrive as errors of status 0; any other error is wrong usage, whatever CLI11's number.
    return app.exit(error) == 0 ? kDone : kBadInput;
  }
  if (!line.command) {
    fmt::print("{}", app.help());
    return kBadInput;
  }
  const ExitStatus status = line.command();
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    spdlog::error("standard output can't be written");
    return status == kDone ? kRunFailed : status;
  }
  return status;
}

}  // namespace
}  // namespace hooke::cli

int main(int argc, char** argv) {
  // Makes a write beyond the limit on file sizes fail with an error, like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  hooke::cli::start_log(false);
  try {
    return hooke::cli::parse_and_run(argc, argv);
  } catch (const std::bad_alloc&) {
    spdlog::error("out of memory");
  } catch (const std::exception& error) {
    spdlog::error("unexpected: {}", error.what());
  }
  return hooke::cli::kRunFailed;
}
