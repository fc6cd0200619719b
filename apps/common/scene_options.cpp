// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "scene_options.h"

#include <CLI/CLI.hpp>

#include "choice.h"

namespace hooke::cli {

namespace {
constexpr int kMostThreads = 1024;
}  // namespace

void add_scene_options(CLI::App& command, SceneArguments& scene) {
  command.add_option("SCENE", scene.file, "scene file (JSON)")->required();
  command
      .add_option("--set", scene.overrides,
                  "replace a value of the scene, e.g. materials.water.radius=0.1; may be repeated")
      ->option_text("PATH=VALUE")
      ->allow_extra_args(false);
  command.add_flag("--allow-outside", scene.allow_outside, "let paths in the scene lead out of its folder");
}

void add_device_options(CLI::App& command, DeviceArguments& device) {
  command.add_option("--threads", device.threads, "threads to use, of each rank (default: all)")
      ->option_text("N")
      ->check(CLI::Range(1, kMostThreads));
  command
      .add_option(
          "--device", device.device,
          "cpu (default), cuda (a GPU of NVIDIA's), auto (cuda where it can be used, else cpu), or reference (all "
          "pairs, double)")
      ->option_text("DEVICE")
      ->check(CLI::IsMember({"cpu", "cuda", "auto", "reference"}), kChoices);
}

}  // namespace hooke::cli
