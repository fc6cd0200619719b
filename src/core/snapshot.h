// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "hooke/core/particles.h"

namespace hooke {

/// The particles at one instant. A snapshot that a simulation has handed out never changes, and lives for as long as
/// any thread keeps it.
struct Snapshot {
  std::int64_t step = 0;  ///< steps done
  double time = 0;        ///< step * dt, s
  ParticleSet particles;  ///< with accelerations where the integrator has them, unless it was read from a run
};

}  // namespace hooke
