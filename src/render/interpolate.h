// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"

namespace hooke {

/// The particles of a run at one time, by ascending id.
struct Moment {
  double time = 0;  ///< s
  const ParticleSet& particles;
};

/// The particles of `before` as they are at `time`, for films that show more instants than a run has written: each on
/// the cubic path that leaves and arrives with its velocities in both moments, the short way across periodic faces,
/// straight on where it is not in `after` any more. before.time <= time <= after.time. For pictures: no law of the
/// scene is asked.
ParticleSet interpolate(const Scene& scene, const Moment& before, const Moment& after, double time);

/// The particles as they were `seconds` >= 0 ago, for an instant between two steps: x - v dt, inside of periodic faces.
ParticleSet drawn_back(const Scene& scene, const ParticleSet& particles, double seconds);

}  // namespace hooke
