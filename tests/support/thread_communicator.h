// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>

#include "hooke/core/communicator.h"

namespace hooke::test {

/// The seconds by which the clock of a rank that owns a box goes on whenever someone looks at it. Where there is none,
/// clocks stand still.
using BoxCost = std::function<double(const Box3d&)>;

/// Runs body(communicator) on `ranks` threads, each of which is a rank: sanitizers and debuggers see them all. Returns
/// when all have ended; a rank's abort() fails the test, and the program.
void run_ranks(int ranks, const std::function<void(std::shared_ptr<Communicator>)>& body, const BoxCost& cost = {});

}  // namespace hooke::test
