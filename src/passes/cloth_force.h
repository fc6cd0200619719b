// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/core/placed_fields.h"
#include "hooke/passes/particle_record.h"
#include "hooke/physics/periodic.h"

namespace hooke {

/// The force of a field on each corner of a triangle of cloth, N; 0 where the triangle's middle is not in it.
template <class Real>
HOOKE_HD Vec3<Real> force_on_corner(const FieldView<Real>& field, const Vec3<Real>& period,
                                    const ParticleRecord<Real>& a, const ParticleRecord<Real>& b,
                                    const ParticleRecord<Real>& c) {
  constexpr Real kThird = Real(1.0 / 3);
  const Vec3<Real> edge_1 = nearest_displacement(b.x, a.x, period);
  const Vec3<Real> edge_2 = nearest_displacement(c.x, a.x, period);
  const Vec3<Real> middle = a.x + kThird * (edge_1 + edge_2);
  if (!field.acts_on(static_cast<std::size_t>(a.material), middle)) return {Real(0), Real(0), Real(0)};
  return field.force_on_corner(middle, edge_1, edge_2, kThird * ((a.v + b.v) + c.v));
}

}  // namespace hooke
