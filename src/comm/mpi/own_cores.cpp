// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/comm/mpi/own_cores.h"

#include <mpi.h>
#include <sched.h>

#include <algorithm>
#include <thread>
#include <vector>

namespace hooke {
namespace {

// The cores that this process may run on; all where there are more than a set can name.
cpu_set_t allowed_cores() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  if (sched_getaffinity(0, sizeof cores, &cores) == 0) return cores;
  const auto all = std::min<std::size_t>(std::max(1U, std::thread::hardware_concurrency()), CPU_SETSIZE);
  for (std::size_t core = 0; core < all; ++core) CPU_SET(core, &cores);
  return cores;
}

// One entry for each rank of this node.
std::vector<cpu_set_t> allowed_on_this_node(const cpu_set_t& own) {
  MPI_Comm node = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
  int ranks = 1;
  MPI_Comm_size(node, &ranks);
  std::vector<cpu_set_t> all(static_cast<std::size_t>(ranks));
  MPI_Allgather(&own, sizeof own, MPI_BYTE, all.data(), sizeof own, MPI_BYTE, node);
  MPI_Comm_free(&node);
  return all;
}

}  // namespace

int own_cores() {
  const cpu_set_t own = allowed_cores();
  int sharing = 0;
  for (const cpu_set_t& other : allowed_on_this_node(own)) {
    cpu_set_t both;
    CPU_AND(&both, &own, &other);
    if (CPU_COUNT(&both) > 0) ++sharing;
  }
  return std::max(1, CPU_COUNT(&own) / std::max(1, sharing));
}

int ranks_on_this_node() { return static_cast<int>(allowed_on_this_node(allowed_cores()).size()); }

}  // namespace hooke
