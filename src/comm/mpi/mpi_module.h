// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "hooke/base/expected.h"
#include "hooke/core/communicator.h"

// What the module hooke-mpi.so exports, for programs that load what needs MPI only when several ranks were started. To
// be called only where hooke_mpi_version() is the caller's.

/// The version of Hooke that the module is of, e.g. "1.2.3".
extern "C" const char* hooke_mpi_version();
/// join_ranks().
extern "C" void hooke_join_ranks(int launched, hooke::Expected<std::shared_ptr<hooke::Communicator>>& joined);
/// own_cores().
extern "C" int hooke_own_cores();
/// ranks_on_this_node().
extern "C" int hooke_ranks_on_this_node();
