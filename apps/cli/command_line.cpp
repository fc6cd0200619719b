// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <utility>
#include <vector>

#include "choice.h"
#include "hooke/render/film.h"
#include "picture_options.h"
#include "scene_options.h"

namespace hooke::cli {
namespace {

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
  });
}

void add_check(CLI::App& app, CommandLine& line) {
  CLI::App& command =
      *app.add_subcommand("check", "validate a scene; its size, step against stability, overlaps at the start");
  add_scene_options(command, line.check.scene);
  command.add_flag("--strict", line.check.strict, "exit with status 2 where the step is unstable");
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
}

void add_render(CLI::App& app, CommandLine& line) {
  CLI::App& command = *app.add_subcommand("render", "draw a picture or a film of a run");
  RenderArguments& render = line.render;
  command.add_option("RUN", render.run, "run folder")->required();
  command
      .add_option("-o,--output", render.output,
                  fmt::format("picture (.png; .exr: in linear light), numbered pictures (frame_%04d.png) or film ({})",
                              render::film_extensions()))
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
  command.add_flag("--alpha", render.picture.alpha, "pictures (.png, .exr) with alpha, without ground, sky and legend");
  command
      .add_option("--set", render.overrides,
                  "replace a value of the run's scene, e.g. camera.orbit=5 or picture.box=false; may be repeated")
      ->option_text("PATH=VALUE")
      ->allow_extra_args(false);
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
  std::vector<std::pair<std::string, io::ExportContent>> contents;
  for (const io::ExportContent content : kContents) contents.emplace_back(to_string(content), content);
  add_choice(command, "--as", exports.content, contents,
             "what to write: particles (default), surface, volume, contacts, cloths or springs")
      ->option_text("CONTENT");
  const auto add_surface_option = [&command](const char* name, double& value, const char* description) {
    return command.add_option(name, value, fmt::format("{} (default: {})", description, value))->option_text("R");
  };
  volumes::SurfaceOptions& surface = exports.surface;
  add_surface_option("--surface-radius", surface.radius, "of the sphere that a particle stands for, in its own radii");
  add_surface_option("--surface-smoothing", surface.smoothing,
                     "how far beyond it a particle blends with others, in its own radii");
  add_surface_option("--surface-resolution", surface.resolution, "edge of a voxel, in radii of the smallest particle");
  command.footer(format_list);
}

void add_others(CLI::App& app, CommandLine& line) {
  CLI::App& info = *app.add_subcommand("info", "say what a run folder, snapshot file or checkpoint holds");
  auto* const info_file = info.add_option("FILE", line.info.file, "run folder or file of one");
  auto* const info_devices =
      info.add_flag("--devices", line.info.devices, "list what --device can take on this machine, instead");
  info_file->excludes(info_devices);
  app.add_subcommand("scenes", "list the scenes that come with Hooke");
  app.add_subcommand("schema", "print the JSON Schema of scene files");
  CLI::App& help = *app.add_subcommand("help", "print the help of the program or of a command");
  help.add_option("COMMAND", line.help_topic, "a command, for instance run");
}

// The window is a program of its own, which knows its options.
void add_view(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("view", "open a window in which a scene runs and can be touched and tuned");
  command.prefix_command();
  command.set_help_flag();
}

}  // namespace

void add_commands(CLI::App& app, CommandLine& line) {
  app.require_subcommand(0, 1);
  add_run(app, line);
  add_check(app, line);
  add_bench(app, line);
  add_render(app, line);
  add_export(app, line);
  add_view(app);
  add_others(app, line);
}

}  // namespace hooke::cli
