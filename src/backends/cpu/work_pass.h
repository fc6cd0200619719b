// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "hooke/base/vec3.h"
#include "hooke/passes/exact_parts.h"
#include "hooke/passes/particle_record.h"
#include "hooke/passes/work_sum.h"

namespace hooke {

// Interface of the pass that sums the work of an applied force; rules of inclusion as in force_pass.h.

/// A force on consecutive particles in a kick, and which of its sums are wanted.
template <class Real>
struct ForceWork {
  static constexpr std::size_t kMost = ExactParts::kMost;
  const ParticleRecord<Real>* before = nullptr;  // the first particle's
  const ParticleRecord<Real>* after = nullptr;
  const Vec3<Real>* force = nullptr;             // N
  const Vec3<Real>* acceleration = nullptr;      // velocity Verlet: of the coming kick, m/s^2; else null
  Real kick{};                                   // duration of a kick, s
  std::size_t count = 0;                         // at most kMost; whole slices of 16 can be read
  bool has_resultant = true;                          // the force itself is summed too
};

/// Adds up WorkSum::count sums.
template <class Real>
using WorkPassFunction = void (*)(const ForceWork<Real>& work, ExactParts* sums);

}  // namespace hooke
