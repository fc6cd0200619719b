// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/scene/findings.h"
#include "hooke/scene/load_scene.h"

namespace hooke {

/// Adds a finding where so many pairs of particles overlap that no list of them fits into memory: how many, and which
/// pair overlaps most. Scenes that are not so crowded cost next to nothing.
void refuse_overlaps(const Scene& scene, const ParticleSet& particles, const LoadOptions& options, Findings& findings);

}  // namespace hooke
