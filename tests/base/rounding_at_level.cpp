// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Compiled once for each level of optimisation: what single_precision_test.cpp asks at each.

#include <cstddef>

#include "hooke/base/single_precision.h"

namespace hooke::test::HOOKE_LEVEL {

Vec3d rounded(const Vec3d& a) { return to_single_precision(a); }

void round_all(Vec3d* vectors, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) vectors[i] = to_single_precision(vectors[i]);
}

}  // namespace hooke::test::HOOKE_LEVEL
