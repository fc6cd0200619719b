// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/backend.h"

namespace hooke {

struct CpuOptions {
  Precision precision = Precision::single_precision;  ///< must be the scene's
  int threads = 0;                                    ///< 1 to 1024; 0: as many as the machine has
  std::string isa;  ///< "scalar", "portable", "avx2", "avx512"; empty: the widest that this processor has
  bool check_list = false;  ///< for tests: after every step, count the contacts that the rows lack, by a full search
};

/// The fast back end: sorted cells, a neighbour list in lanes, forces and integration in one SIMD pass on all threads.
/// Gives the same bits for every number of threads and every instruction set. Error::Kind::bad_input for an
/// instruction set that is not available, or a number of threads out of range.
Expected<std::unique_ptr<Backend>> make_cpu_backend(const CpuOptions& options = {});

/// The names of the instruction sets that CpuOptions can ask for on this processor, the widest first.
std::vector<std::string> cpu_instruction_sets();

}  // namespace hooke
