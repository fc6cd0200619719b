// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "hooke/scene/lattice.h"

namespace hooke::scene {

/// Asks for as many centres as fit.
inline constexpr std::uint64_t kAsManyAsFit = std::numeric_limits<std::uint64_t>::max();

/// Random sequential addition: centres drawn at random in a box, each kept if it is at least `spacing` (m, > 0) from
/// all centres before. Draws come from the space still free, so the loop ends: with `count` centres, or when next to no
/// room is left (about 0.7 centres a cubed spacing). The same seed gives the same centres on every machine.
std::vector<Vec3d> random_packing(const Box3d& box, double spacing, std::uint64_t count, std::uint64_t seed);

/// Upper bound of the number of centres that random_packing can place.
double random_packing_bound(const Box3d& box, double spacing);

}  // namespace hooke::scene
