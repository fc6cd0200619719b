// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/scene/findings.h"
#include "hooke/scene/load_scene.h"

namespace hooke::scene {

/// Adds a finding where so many pairs of particles overlap that their list does not fit into memory: how many pairs,
/// and which pair overlaps most. Costs next to nothing for less crowded scenes.
void refuse_overlaps(const Scene& scene, const ParticleSet& particles, const LoadOptions& options, Findings& findings);

}  // namespace hooke::scene
