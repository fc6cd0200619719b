// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "hooke/base/box3.h"
#include "hooke/core/particles.h"
#include "hooke/core/scene.h"

namespace hooke::render {

/// Where a scene's action takes place, judged by its start, `first`: the domain, cut a little above the highest
/// particle; where it is far larger than what is in it, cut around that as well, with room to fall and to spread.
Box3d action_box(const Scene& scene, const ParticleSet& first);

/// The same where more is known: particles at several times of a run, the first of them at its start, at least one.
/// Tight around what nearly all of them reach, and down to the floor where that is near.
Box3d seen_action_box(const Scene& scene, std::span<const ParticleSet> moments);

}  // namespace hooke::render
