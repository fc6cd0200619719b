// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/backends/cpu/force_pass.h"
#include "hooke/backends/cpu/particle_record.h"
#include "hooke/base/vec3.h"
#include "hooke/physics/periodic.h"

namespace hooke {

/// Brings coordinates along periodic axes back into the domain.
template <class Real>
void wrap_periodic(const ForcePass<Real>& pass, ParticleRecord<Real>& p) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!pass.periodic[axis]) continue;
    Real& x = component(p.x, axis);
    x = wrap_coordinate(x, component(pass.min, axis), component(pass.max, axis));
  }
}

/// Whether the centre has left through an open face.
template <class Real>
bool is_outside_open_face(const ForcePass<Real>& pass, const ParticleRecord<Real>& p) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!pass.open_or_periodic[axis] || pass.periodic[axis]) continue;
    const Real x = component(p.x, axis);
    if (x < component(pass.min, axis) || x > component(pass.max, axis)) return true;
  }
  return false;
}

}  // namespace hooke
