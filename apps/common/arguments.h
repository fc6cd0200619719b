// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/run/open_simulation.h"

namespace hooke::cli {

using run::DeviceArguments;
using run::SceneArguments;

/// The exit status of the program.
enum ExitStatus : int {
  kDone = 0,
  kBadInput = 2,       ///< bad input or usage; nothing was written
  kRunFailed = 3,      ///< the run failed or could not be written; the last good state is kept
  kInterrupted = 130,  ///< stopped by a signal; the checkpoint is written
};

}  // namespace hooke::cli
