// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/scene/findings.h"
#include "hooke/scene/load_scene.h"

namespace hooke::scene {

/// Estimates the number of overlapping pairs as if every cell, as wide as the largest diameter, were filled evenly. The
/// estimate may be too high, because cells share counters.
class PairEstimate {
 public:
  /// For particles of radii up to `radius` (m), about so many.
  PairEstimate(double radius, double particles);
  void add(std::span<const Vec3d> positions);
  /// Of the particles added, `particles` in all: then the estimate is not lower than it would have been if that number
  /// had been known. Nothing can be added after it.
  double most_pairs(std::uint64_t particles);

 private:
  double radius_;
  std::vector<std::uint32_t> count_;  // 2^n
};

/// Whether the list of so many pairs fits into memory.
bool has_room_for_pairs(double pairs, const LoadOptions& options);

/// Adds a finding where so many pairs of particles overlap that their list does not fit into memory: how many pairs,
/// and which pair overlaps most. Costs next to nothing for less crowded scenes.
void refuse_overlaps(const Scene& scene, const ParticleSet& particles, const LoadOptions& options, Findings& findings);

}  // namespace hooke::scene
