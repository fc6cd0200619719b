// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "hooke/backends/cpu/force_pass.h"
#include "hooke/base/expected.h"

namespace hooke {

/// One build of the force pass.
struct Isa {
  const char* name;  ///< "portable", "avx2", "avx512"
  ForcePassFunction<float> single_pass;
  ForcePassFunction<double> double_pass;
};

/// The instruction sets that this processor has, the widest first.
std::vector<Isa> available_isas();

/// The one of this name, or the widest where `name` is empty. Error::Kind::bad_input names those there are.
Expected<Isa> choose_isa(const std::string& name);

}  // namespace hooke
