// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/simulation.h"
#include "hooke/run/open_simulation.h"

namespace hooke::run {

/// A sentence about a time step that is too long for the scene; empty if it is not too long.
std::string unstable_step(const Simulation& simulation);

/// The distance between neighbouring single-precision numbers at the domain's coordinate farthest from 0.
struct FloatSpacing {
  double metres = 0;
  double radii = 0;  ///< in radii of the smallest particle; 0 without particles' materials
};
FloatSpacing float_spacing(const Scene& scene);

/// What the particles of a run that begins overlap or are inside of: a sentence for each wall and each collider.
std::vector<std::string> overlapped_bodies(const Simulation& simulation);

/// What is most likely a mistake among them: centres inside of solids, overlaps deeper than half a radius. Each has the
/// JSON path of its entry. None for a run that goes on from a checkpoint.
std::vector<Finding> deep_starts(const Simulation& simulation);

/// A sentence about particles that are too soft for their depth, with the stiffness that would do: where they overlap
/// by more than 5 % of the sum of their radii on average, so by about 10 % at the bottom; empty where they do not.
std::string soft_particles(const Simulation& simulation, const Measurements& now);

/// A sentence about a domain too large for the single precision in use; empty if it is not too large.
std::string coarse_positions(const Simulation& simulation);

/// A sentence about ranks of too few particles to be worth it; empty where they have enough or more
/// are to be born, and for one alone.
std::string small_ranks(const OpenedSimulation& opened);

}  // namespace hooke::run
