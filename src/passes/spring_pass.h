// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "hooke/base/vec3.h"
#include "hooke/neighbours/layout.h"
#include "hooke/passes/particle_record.h"

namespace hooke {

// Interface of the spring pass; rules of inclusion as in force_pass.h.

/// What springs of one kind share: four numbers, so that a pack of kinds loads like a pack of records.
template <class Real>
struct alignas(4 * sizeof(Real)) SpringKind {
  Real stiffness;     // N/m
  Real damping;       // N s/m
  Real break_strain;  // infinite: never
  Real side;          // as spring_acts() takes it
};

/// The first two kinds stand for no spring, and for a spring that broke in this pass. They never act.
inline constexpr std::uint32_t kNoSpring = 0, kTornSpring = 1, kFirstSpringKind = 2;

/// The k-th springs of 16 consecutive particles, one a lane.
template <class Real>
struct SpringRow {
  std::uint32_t partner[16];  // record_offset() of the other end
  std::uint32_t kind[16];
  Real rest_length[16];  // m
};

/// What every slice of a pass needs.
template <class Real>
struct SpringPass {
  const ParticleRecord<Real>* records = nullptr;
  const SpringKind<Real>* kinds = nullptr;
  Vec3<Real>* force = nullptr;  // N, one per particle: written
  bool may_tear = false;        // springs that are stretched too far become kTornSpring
  bool any_periodic = false;
  bool periodic[3]{};
  Vec3<Real> length{};  // of the domain, m
};

/// Consecutive slices of 16 particles.
template <class Real>
struct SpringWork {
  std::size_t first = 0;  // first particle
  std::size_t slice_count = 0;
  SpringRow<Real>* rows = nullptr;            // of the whole list
  const std::uint32_t* first_row = nullptr;   // slice_count + 1, indices into rows
  Real* power = nullptr;  // W, one entry per particle: half of the power that its dampers take out
  unsigned char* torn = nullptr;  // one entry a slice: whether a spring became kTornSpring
};

template <class Real>
using SpringPassFunction = void (*)(const SpringPass<Real>&, const SpringWork<Real>&);

}  // namespace hooke
