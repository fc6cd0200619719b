// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"

namespace hooke {

/// How much air is mixed with the particles around each one, in the set's order: 0 in a pool and at its smooth
/// surface, up to 1 in spray. Follows from the share of the space within a few radii, and inside the domain, that
/// particles fill. `radius`: of a typical particle, m, > 0. The same for any number of threads.
std::vector<float> aeration(const Scene& scene, const ParticleSet& particles, double radius);

}  // namespace hooke
