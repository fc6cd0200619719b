// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/base/vec3.h"

namespace hooke {

/// The double that a single-precision number next to `a` holds. Through memory that the compiler may not look through:
/// GCC 12 at -O2 drops the rounding of two of a vector's components that are cast to float and back.
inline double to_single_precision(double a) {
  const volatile float rounded = static_cast<float>(a);
  return static_cast<double>(rounded);
}
inline Vec3d to_single_precision(const Vec3d& a) {
  return {to_single_precision(a.x), to_single_precision(a.y), to_single_precision(a.z)};
}

}  // namespace hooke
