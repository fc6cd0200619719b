// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace hooke {

/// Philox4x32-10: four random 32-bit words from a counter and a key (Salmon, Moraes, Dror, Shaw,
/// "Parallel random numbers: as easy as 1, 2, 3", SC 2011). A pure function: the same on every
/// machine, in any order, by any thread.
constexpr std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter,
                                                  std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = std::uint64_t{0xD2511F53U} * counter[0];
    const std::uint64_t b = std::uint64_t{0xCD9E8D57U} * counter[2];
    counter = {static_cast<std::uint32_t>(b >> 32U) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
               static_cast<std::uint32_t>(a >> 32U) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
    key[0] += 0x9E3779B9U;
    key[1] += 0xBB67AE85U;
  }
  return counter;
}

/// Random numbers for one particle (or one site): `seed` selects the stream, `index` the particle, `draw` the group of
/// four numbers. Each is uniform in [0, 1) with 32 bits.
constexpr std::array<double, 4> uniform4(std::uint64_t seed, std::uint64_t index, std::uint32_t draw,
                                         std::uint32_t purpose = 0) {
  const auto words =
      philox4x32({static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32U), draw, purpose},
                 {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U)});
  constexpr double kScale = 1.0 / 4294967296.0;
  return {words[0] * kScale, words[1] * kScale, words[2] * kScale, words[3] * kScale};
}

}  // namespace hooke
