// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "hooke/run/open_simulation.h"

namespace CLI {
class App;
}

namespace hooke::view {

/// What the command line of `hooke view` says.
struct ViewArguments {
  run::SceneArguments scene;  ///< no file where a record is replayed
  run::DeviceArguments device;
  std::filesystem::path resume, record, replay, status;
  bool headless = false, paused = false;
  int width = 1280, height = 720;
};

/// Adds the options of `hooke view`; they write into `arguments`, which must live as long as `app`.
void add_view_options(CLI::App& app, ViewArguments& arguments);

}  // namespace hooke::view
