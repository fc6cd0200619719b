// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hooke/base/bytes.h"
#include "hooke/core/particle_slices.h"
#include "hooke/core/particles.h"

namespace hooke {

// Particles as the bytes of a message to another rank.

/// Adds those of these indices.
inline void append_particles(std::vector<std::byte>& to, const ParticleSlice& from,
                             std::span<const std::size_t> which) {
  constexpr std::size_t kBytes = sizeof(std::uint64_t) + sizeof(std::uint16_t) + 3 * sizeof(Vec3d);
  to.reserve(to.size() + which.size() * kBytes + sizeof(std::size_t) + 1);
  append_bytes(to, which.size());
  append_bytes(to, static_cast<std::uint8_t>(from.acceleration.empty() ? 0 : 1));
  const auto column = [&](const auto& of) {
    for (const std::size_t i : which) append_bytes(to, of[i]);
  };
  column(from.id);
  column(from.material);
  column(from.position);
  column(from.velocity);
  if (!from.acceleration.empty()) column(from.acceleration);
}

/// Adds all of them.
inline void append_particles(std::vector<std::byte>& to, const ParticleSlice& from) {
  append_bytes(to, from.size());
  append_bytes(to, static_cast<std::uint8_t>(from.acceleration.empty() ? 0 : 1));
  const auto column = [&](const auto& of) { append_bytes(to, of.data(), of.size()); };
  column(from.id);
  column(from.material);
  column(from.position);
  column(from.velocity);
  column(from.acceleration);
}

/// Appends those of one message to `to`.
inline void take_particles(std::span<const std::byte> from, ParticleSet& to) {
  std::size_t count = 0;
  std::uint8_t accelerated = 0;
  take_bytes(from, count);
  take_bytes(from, accelerated);
  const auto column = [&](auto& of) {
    const std::size_t before = of.size();
    of.resize(before + count);
    take_bytes(from, of.data() + before, count);
  };
  column(to.id);
  column(to.material);
  column(to.position);
  column(to.velocity);
  if (accelerated != 0) column(to.acceleration);
}

}  // namespace hooke
