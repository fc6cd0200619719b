// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"

namespace hooke::render {

/// The particles of a run at one time, by ascending id.
struct Moment {
  double time = 0;  ///< s
  const ParticleSet& particles;
};

/// The particles of `before` at `time`, for films that show more instants than a run has written. Each particle moves
/// on the cubic path with its positions and velocities in both moments, the short way across periodic faces; a
/// particle that is not in `after` any more moves straight on. before.time <= time <= after.time. For pictures only:
/// the laws of the scene play no part.
ParticleSet interpolate(const Scene& scene, const Moment& before, const Moment& after, double time);

/// The particles `seconds` >= 0 ago, for an instant between two steps: x - v seconds, wrapped at periodic faces.
ParticleSet drawn_back(const Scene& scene, const ParticleSet& particles, double seconds);

}  // namespace hooke::render
