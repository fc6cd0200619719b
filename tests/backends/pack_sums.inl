// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Compiled once for each instruction set, which HOOKE_ISA names.

#include "hooke/backends/cpu/pack_sums.h"

#include "pack_sums.h"

namespace hooke::test::HOOKE_ISA {

void add_numbers(const float* values, std::size_t count, ExactParts& parts) {
  hooke::HOOKE_ISA::add_parts(values, count, parts);
}
void add_numbers(const double* values, std::size_t count, ExactParts& parts) {
  hooke::HOOKE_ISA::add_parts(values, count, parts);
}

}  // namespace hooke::test::HOOKE_ISA
