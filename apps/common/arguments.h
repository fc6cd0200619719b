// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hooke::cli {

/// The exit status of the program.
enum ExitStatus : int {
  kDone = 0,
  kBadInput = 2,       ///< bad input or usage; nothing was written
  kRunFailed = 3,      ///< the run failed or could not be written; the last good state is kept
  kInterrupted = 130,  ///< stopped by a signal; the checkpoint is written
};

/// The scene, and how it is read.
struct SceneArguments {
  std::filesystem::path file;
  std::vector<std::string> overrides;  ///< PATH=VALUE
  bool allow_outside = false;
};

/// The back end.
struct DeviceArguments {
  std::string device = "cpu";
  int threads = 0;  ///< 0: as many as the machine has
};

}  // namespace hooke::cli
