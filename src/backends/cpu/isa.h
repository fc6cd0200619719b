// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "hooke/backends/cpu/attraction_pass.h"
#include "hooke/backends/cpu/tile_pass.h"
#include "hooke/backends/cpu/work_pass.h"
#include "hooke/base/expected.h"
#include "hooke/neighbours/window_search.h"
#include "hooke/passes/spring_pass.h"

namespace hooke {

/// The inner loops in one precision.
template <class Real>
struct Loops {
  ForcePassFunction<Real> force_pass;
  WindowSearchFunction<Real> search_window;
  SpringPassFunction<Real> spring_pass;
  WorkPassFunction<Real> work_pass;
  AttractionLoops<Real> attraction;
};

/// One build of the inner loops.
struct Isa {
  const char* name;  ///< "scalar", "portable", "avx2", "avx512"
  Loops<float> single_loops;
  Loops<double> double_loops;
};

/// The instruction sets that this processor has, the widest first.
std::vector<Isa> available_isas();

/// The instruction set of this name, or the widest where `name` is empty. Error::Kind::bad_input lists the names.
Expected<Isa> choose_isa(const std::string& name);

}  // namespace hooke
