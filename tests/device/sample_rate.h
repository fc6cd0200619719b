// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"

namespace hooke::test {

/// Steps a second of the scheme of sample_engine.h on the first GPU, over at least a second, from `particles` on.
double sample_rate(const Scene& scene, const ParticleSet& particles);

}  // namespace hooke::test
