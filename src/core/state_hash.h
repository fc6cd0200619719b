// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <type_traits>

#include "hooke/base/hash.h"
#include "hooke/base/vec3.h"

namespace hooke {

/// One particle's part of the state hash: a mix of its id and of the bits of its position and velocity, in the
/// precision R that the back end holds them in. Parts are summed modulo 2^64, so their order does not matter.
template <class R>
HOOKE_HD std::uint64_t particle_hash(std::uint64_t id, const Vec3<R>& x, const Vec3<R>& v) {
  using Bits = std::conditional_t<sizeof(R) == 4, std::uint32_t, std::uint64_t>;
  std::uint64_t hash = mix64(id);
  const auto mix_in = [&](const Vec3<R>& a) {
    hash = combine64(hash, __builtin_bit_cast(Bits, a.x));
    hash = combine64(hash, __builtin_bit_cast(Bits, a.y));
    hash = combine64(hash, __builtin_bit_cast(Bits, a.z));
  };
  mix_in(x);
  mix_in(v);
  return hash;
}

}  // namespace hooke
