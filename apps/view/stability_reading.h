// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "hooke/core/simulation.h"

namespace hooke::view {

/// How the contacts of a material behave, against its own kind (docs/theory.md section 4).
struct MaterialReading {
  std::string name;
  double damping_ratio = 0;
  double restitution = 0;    ///< out over in speed of a head-on impact, 0 to 1
  double contact_steps = 0;  ///< how long an impact lasts, in steps; infinite without a spring
};

/// What a step of a scene is measured by.
struct StabilityReading {
  StableStep stable;
  double safe_step = 0;  ///< s: four fifths of the stable one, in two digits; infinite where that is
  std::vector<MaterialReading> materials;
};

/// `particles`: for the springs between them.
StabilityReading read_stability(const Scene& scene, const ParticleSet& particles);

}  // namespace hooke::view
