// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "hooke/backends/gpu/device.h"
#include "hooke/neighbours/layout.h"

namespace hooke::gpu {

// What the 32 items of a warp, consecutive and the first a multiple of 32, find out together. All of them must call
// these functions: kernels that do are run on whole warps. Without a GPU each item answers for itself.

inline constexpr std::uint32_t kWarp = 32;

/// The lanes of a slice (neighbours/layout.h), for numbers of slots.
inline constexpr auto kLanes = static_cast<std::uint32_t>(kSliceLanes);

/// Whether the condition holds for any item of the warp.
HOOKE_HD bool any_in_warp(bool condition) {
#if defined(__CUDA_ARCH__)
  return __any_sync(~0U, condition);
#else
  return condition;
#endif
}

/// Raises a number of the warp to the largest of its items' numbers.
HOOKE_HD void raise_by_warp(std::uint32_t* number, std::uint32_t a) {
#if defined(__CUDA_ARCH__)
  const std::uint32_t most = __reduce_max_sync(~0U, a);
  if ((threadIdx.x & (kWarp - 1)) == 0 && *static_cast<volatile std::uint32_t*>(number) < most) atomicMax(number, most);
#else
  raise_to(number, a);
#endif
}

/// A float as a whole number that grows with it, above 0 for every number but NaN.
HOOKE_HD std::uint32_t ordered(float a) {
  const auto bits = __builtin_bit_cast(std::uint32_t, a);
  return bits ^ ((bits >> 31U) != 0 ? 0xffffffffU : 0x80000000U);
}
HOOKE_HD float from_ordered(std::uint32_t a) {
  return __builtin_bit_cast(float, a ^ ((a >> 31U) != 0 ? 0x80000000U : 0xffffffffU));
}

}  // namespace hooke::gpu
