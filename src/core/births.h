// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hooke/core/emitters.h"
#include "hooke/physics/collider.h"

namespace hooke {

// The random choices of a birth: functions of the emitter's seed, its index in the scene and the number of the birth
// alone (base/random.h), so they are the same on every machine, in any order, on any thread. Plain arithmetic.

/// An emitter where it is at one instant.
struct PlacedEmitter {
  const Emitter* emitter = nullptr;
  std::uint32_t index = 0;        ///< in the scene: emitters of one seed draw different numbers
  PlacedCollider<double> body;    ///< its shape and motion
  Vec3d direction{0, 1, 0};       ///< unit vector, in the body's own frame
  double cosine = 1;              ///< of the spread
  std::span<const double> areas;  ///< areas_of_birth() of the shape
};

/// Whether births are spread over the faces of the shape, as it has no inside.
bool is_open_mesh(const Shape& shape);

/// For an open mesh, the area of each triangle and all before it, m^2; else empty.
std::vector<double> areas_of_birth(const Shape& shape);

/// The `index`-th emitter of a scene at `time` (s). `reach`: a margin around its body's box, m. `areas`, those of
/// its shape, are kept by the caller.
PlacedEmitter place_emitter(const Emitter& emitter, std::uint32_t index, double time, double reach,
                            std::span<const double> areas = {});

/// A position for the birth of this number, m: uniform over the shape, another position for each `attempt`. NaN where a
/// mesh fills so little of the box around it that no position inside was found.
Vec3d draw_position(const PlacedEmitter& emitter, std::uint64_t number, std::uint32_t attempt);

/// The velocity, m/s, of the birth at x (m): speed uniform over its range, direction uniform over the cone's solid
/// angle, both relative to the emitter, whose own velocity there is added.
Vec3d draw_velocity(const PlacedEmitter& emitter, std::uint64_t number, const Vec3d& x);

/// How many steps of `dt` (s, > 0) its life lasts, at least 1: life and decay are uniform over their ranges, and the
/// life ends after the first n steps with n dt decay >= life. Nothing where it lives for ever.
std::optional<std::int64_t> draw_lifetime(const Emitter& emitter, std::uint32_t index, std::uint64_t number, double dt);

}  // namespace hooke
