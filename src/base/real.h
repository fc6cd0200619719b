// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

/// Marks a function that host and device compilers share. Always inlined: one that a file built for
/// AVX-512 emitted out of line could be the copy that the linker keeps for the whole program.
#if defined(__CUDACC__)
#define HOOKE_HD __host__ __device__ __forceinline__
#else
#define HOOKE_HD [[gnu::always_inline]] inline
#endif

namespace hooke {

// The laws are templates of the number type R and use only + - * /, sqrt_of, select and comparisons.
// These overloads make float and double such types; a pack supplies its own, lane by lane.

HOOKE_HD float sqrt_of(float a) { return __builtin_sqrtf(a); }
HOOKE_HD double sqrt_of(double a) { return __builtin_sqrt(a); }

/// `if_true` where `condition` holds, else `if_false`. Both are evaluated; neither value is altered.
HOOKE_HD float select(bool condition, float if_true, float if_false) { return condition ? if_true : if_false; }
HOOKE_HD double select(bool condition, double if_true, double if_false) { return condition ? if_true : if_false; }

}  // namespace hooke
