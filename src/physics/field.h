// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/base/real.h"
#include "hooke/base/vec3.h"

namespace hooke {

// Laws of fields: forces that depend on where a particle is and how it moves, not on other particles (docs/theory.md
// eq. 14 to 16).

/// Drag of a moving medium, N: F = k_d (u - v), eq. 14. `drag` k_d in kg/s, >= 0; the medium's velocity `u` and the
/// particle's `v` in m/s.
template <class R>
HOOKE_HD Vec3<R> wind_force(const Vec3<R>& u, const Vec3<R>& v, const R& drag) {
  return drag * (u - v);
}

/// Force of wind on each corner of a triangle of a sheet, N: a third of F = k_A A (w.n) n, eq. 15. `edge_1`, `edge_2`
/// lead from one corner to the others (m); `w` is the wind relative to the triangle (m/s); `area_drag` k_A in kg/(m^2
/// s), >= 0. A triangle without area feels no force.
template <class R>
HOOKE_HD Vec3<R> sheet_force(const Vec3<R>& edge_1, const Vec3<R>& edge_2, const Vec3<R>& w, const R& area_drag) {
  const Vec3<R> doubled = cross(edge_1, edge_2);  // normal whose length is twice the area
  const R length = sqrt_of(dot(doubled, doubled));
  const R inverse = select(length > R(0), R(1) / length, R(0));
  return ((area_drag * R(1.0 / 6)) * (dot(w, doubled) * inverse)) * doubled;
}

/// Unit vector from `x` to `point`; 0 where they coincide.
template <class R>
HOOKE_HD Vec3<R> direction_to(const Vec3<R>& point, const Vec3<R>& x) {
  const Vec3<R> way = point - x;
  const R distance = sqrt_of(dot(way, way));
  return select(distance > R(0), R(1) / distance, R(0)) * way;
}

/// The driving force of pedestrians, N: F = m (v_0 e - v) / tau, eq. 16 (Helbing and Molnar, Social force model for
/// pedestrian dynamics, Phys. Rev. E 51, 4282, 1995, eq. 2). `direction` e is a unit vector, `speed` v_0 the desired
/// speed in m/s, `rate` m / tau in kg/s.
template <class R>
HOOKE_HD Vec3<R> driving_force(const Vec3<R>& direction, const Vec3<R>& v, const R& speed, const R& rate) {
  return rate * (speed * direction - v);
}

}  // namespace hooke
