// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "view_options.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "scene_options.h"

namespace hooke::view {
namespace {

std::string parse_size(const std::string& text, ViewArguments& arguments) {
  int width = 0, height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 64 || height < 64 || width > 16384 ||
      height > 16384) {
    return text + " is no size such as 1280x720, from 64x64 to 16384x16384";
  }
  arguments.width = width;
  arguments.height = height;
  return {};
}

}  // namespace

void add_view_options(CLI::App& app, ViewArguments& arguments) {
  cli::add_scene_options(app, arguments.scene);
  app.get_option("SCENE")->required(false);
  cli::add_device_options(app, arguments.device);
  app.add_option("--resume", arguments.resume, "go on from a checkpoint of the scene")->option_text("CHECKPOINT");
  app.add_option("--record", arguments.record, "log every action with the step at which it took effect")
      ->option_text("FILE");
  app.add_option("--replay", arguments.replay,
                 "do again what was logged, and compare the states; SCENE may be left out")
      ->option_text("FILE");
  app.add_flag("--headless", arguments.headless, "replay without a window, as fast as possible")->needs("--replay");
  app.add_flag("--paused", arguments.paused, "open the window with the simulation at rest");
  app.add_option("--size", "of the window (default: 1280x720)")
      ->option_text("WxH")
      ->check([&arguments](const std::string& text) { return parse_size(text, arguments); });
  app.add_option("--status", arguments.status, "keep a line of JSON in this file that tells what the window shows")
      ->option_text("FILE");
}

}  // namespace hooke::view
