// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hooke/core/sums.h"

namespace hooke {

/// Particles that leave: the sums of what they carry, and their slots.
struct Departures {
  RemovalSums sums;
  std::vector<std::uint32_t> slots;

  void add(std::size_t slot, double mass, const Vec3d& x, const Vec3d& v, const Vec3d& gravity) {
    sums.add_particle(mass, x, v, gravity);
    slots.push_back(static_cast<std::uint32_t>(slot));
  }
  void add(const Departures& other) {
    if (other.slots.empty()) return;
    sums.add(other.sums);
    slots.insert(slots.end(), other.slots.begin(), other.slots.end());
  }
};

}  // namespace hooke
