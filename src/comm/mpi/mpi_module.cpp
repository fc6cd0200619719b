// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/comm/mpi/mpi_module.h"

#include "hooke/comm/mpi/mpi_communicator.h"
#include "hooke/comm/mpi/own_cores.h"

extern "C" __attribute__((visibility("default"))) const char* hooke_mpi_version() { return HOOKE_VERSION; }

extern "C" __attribute__((visibility("default"))) void hooke_join_ranks(
    int launched, hooke::Expected<std::shared_ptr<hooke::Communicator>>& joined) {
  joined = hooke::join_ranks(launched);
}

extern "C" __attribute__((visibility("default"))) int hooke_own_cores() { return hooke::own_cores(); }

extern "C" __attribute__((visibility("default"))) int hooke_ranks_on_this_node() { return hooke::ranks_on_this_node(); }
