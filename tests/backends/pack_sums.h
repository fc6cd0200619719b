// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "hooke/passes/exact_parts.h"

namespace hooke::test {

// add_parts() of pack_sums.h as each instruction set compiles it.
#define HOOKE_DECLARE_PACK_SUMS(isa)                                            \
  namespace isa {                                                               \
  void add_numbers(const float* values, std::size_t count, ExactParts& parts);  \
  void add_numbers(const double* values, std::size_t count, ExactParts& parts); \
  }
HOOKE_DECLARE_PACK_SUMS(portable)
HOOKE_DECLARE_PACK_SUMS(avx2)
HOOKE_DECLARE_PACK_SUMS(avx512)
#undef HOOKE_DECLARE_PACK_SUMS

}  // namespace hooke::test
