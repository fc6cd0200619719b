// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

// Exact sums without packs: rules of inclusion as in pack.h.

#include <cstddef>

#include "hooke/base/real.h"
#include "hooke/passes/exact_parts.h"

namespace hooke::HOOKE_ISA {

/// Adds `count` numbers, as they are.
template <class Real>
HOOKE_HD void add_parts(const Real* values, std::size_t count, ExactParts& parts) {
  for (std::size_t k = 0; k < count; ++k) parts.values[parts.count++] = static_cast<double>(values[k]);
}

}  // namespace hooke::HOOKE_ISA
