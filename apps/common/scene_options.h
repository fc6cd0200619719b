// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "arguments.h"

namespace CLI {
class App;
}

namespace hooke::cli {

// Options that several commands have in common; they write into the given arguments, which must live as long as the
// command.
void add_scene_options(CLI::App& command, SceneArguments& scene);
void add_device_options(CLI::App& command, DeviceArguments& device);

}  // namespace hooke::cli
