// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "arguments.h"
#include "hooke/io/export.h"
#include "hooke/run/launched_ranks.h"
#include "hooke/run/picture_arguments.h"
#include "hooke/run/recorder.h"

namespace hooke::cli {

using run::PictureArguments;

struct RunArguments : run::RecordArguments {
  SceneArguments scene;
  DeviceArguments device;
  std::filesystem::path report;  ///< empty: only the run folder's
  bool quiet = false;
};

struct CheckArguments {
  SceneArguments scene;
  bool strict = false;
};

struct BenchArguments {
  SceneArguments scene;
  DeviceArguments device;
  std::int64_t steps = 200;
  std::int64_t warmup = 50;
  std::filesystem::path resume;
  bool json = false;
};

struct RenderArguments {
  std::filesystem::path run;
  std::filesystem::path output;
  std::optional<double> time;          ///< of a still, s
  std::optional<double> from, to;      ///< the part of the run that a film shows, s
  std::optional<std::int64_t> every;   ///< a frame for every n-th snapshot, instead of by time
  std::vector<std::string> overrides;  ///< of the run's scene, PATH=VALUE
  PictureArguments picture;
};

struct ExportArguments {
  std::filesystem::path run;
  std::filesystem::path output;
  std::optional<std::int64_t> step;
  std::optional<double> time;
  bool all = false;
  io::ExportContent content = io::ExportContent::particles;
  volumes::SurfaceOptions surface;
};

struct InfoArguments {
  std::filesystem::path file;
  bool devices = false;
};

// One function per command; each prints and returns the exit status. With several ranks rank 0 calls it.
ExitStatus run_command(const RunArguments& arguments, const run::LaunchedRanks& ranks);
ExitStatus check_command(const CheckArguments& arguments);
ExitStatus bench_command(const BenchArguments& arguments, const run::LaunchedRanks& ranks);
ExitStatus render_command(const RenderArguments& arguments);
ExitStatus export_command(const ExportArguments& arguments);
ExitStatus info_command(const InfoArguments& arguments);
ExitStatus scenes_command();
ExitStatus schema_command();
/// Becomes the program hooke-view, which lies beside this one, with these arguments; returns only where it can't.
ExitStatus view_command(const std::vector<std::string>& arguments);

}  // namespace hooke::cli
