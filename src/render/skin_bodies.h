// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"

namespace hooke::render {

/// Which body each particle is part of, from 1 to 255, in the set's order: particles that springs tie together, broken
/// ones too, are one body, and so are all particles of a material that no spring ties. Bodies far down the list share
/// numbers.
std::vector<std::uint8_t> skin_bodies(const Scene& scene, const ParticleSet& particles);

}  // namespace hooke::render
