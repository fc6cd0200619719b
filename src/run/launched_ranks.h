// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "hooke/base/expected.h"
#include "hooke/core/communicator.h"

namespace hooke::run {

/// A process among those that were started together, as the environment of the launcher, mpirun or srun, says.
struct LaunchedRank {
  int rank = 0;
  int ranks = 1;  ///< in all
};
LaunchedRank launched_rank();

/// The ranks that mpirun or srun has started, of which this process is one. Rank 0 runs the program as if it were
/// alone: it opens a simulation on all of them (open_simulation.h), and what it then asks of it the others take part
/// in, for which they follow_ranks(). At its end it calls release_ranks().
struct LaunchedRanks {
  std::shared_ptr<Communicator> communicator;  ///< null: this process is alone
  int cores = 1;  ///< for this rank: those that it is bound to; its share of them where other ranks are bound to them
  int on_this_machine = 1;  ///< of the ranks, this one included

  int rank() const { return communicator ? communicator->rank() : 0; }
  int size() const { return communicator ? communicator->size() : 1; }
};

/// The ranks that were started together with this process, or this one alone. To be called once in a program, by the
/// thread that will step simulations. bad_input where there are several and the build has no MPI: the same on all.
Expected<LaunchedRanks> join_launched_ranks();

/// On ranks above 0, in place of the program: takes part in what rank 0 opens and asks, until it releases the ranks.
/// Returns the exit status that rank 0 gives. Ends the program on all ranks where this one has no memory for its part.
int follow_ranks(const LaunchedRanks& ranks);

/// On rank 0, at its end: the others return from follow_ranks() with its exit status.
void release_ranks(const LaunchedRanks& ranks, int status);

}  // namespace hooke::run
