// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"

namespace hooke::render {

/// How water around a particle is mixed with air, within a box of a few radii on each side.
struct WaterMixing {
  float filled = 0;  ///< share of the space inside the domain that particles fill, over that in a pool: 1; in a drop 0
  float churn = 0;  ///< root mean square of the velocities relative to their mean, m/s; up to about `fastest`
};

/// The mixing around each particle, in the set's order, the same for any number of threads. `radius`: of a typical
/// particle, m, > 0; `fastest`: speed that sets the resolution of churn, m/s, > 0; speeds above twice it count as that.
std::vector<WaterMixing> water_mixing(const Scene& scene, const ParticleSet& particles, double radius, double fastest);

}  // namespace hooke::render
