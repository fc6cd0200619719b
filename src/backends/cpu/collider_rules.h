// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hooke/backends/cpu/pass_rules.h"
#include "hooke/core/placed_colliders.h"
#include "hooke/core/scene.h"

namespace hooke {

/// A scene's colliders as the force pass wants them, and where they are.
template <class Real>
struct ColliderRules {
  PlacedColliders<Real> placed;
  std::vector<PairRow<Real>> pairs;  ///< a row of materials a collider

  void configure(const Scene& scene, std::size_t material_count);

  /// Moves them, and aims `pass` at them. `reach`: how far from a particle's centre one acts on it, m.
  void place(const Scene& scene, std::span<const ColliderPose> poses, double reach, ForcePass<Real>& pass);
};

extern template struct ColliderRules<float>;
extern template struct ColliderRules<double>;

}  // namespace hooke
