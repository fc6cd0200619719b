// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/base/expected.h"
#include "hooke/run/launched_ranks.h"

namespace hooke::run {

/// Joins the ranks by hooke-mpi.so (module_loader.h). bad_input where the build has no such module, or MPI finds
/// another number of ranks.
Expected<LaunchedRanks> load_ranks(int launched);

}  // namespace hooke::run
