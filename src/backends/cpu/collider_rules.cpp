// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/collider_rules.h"

#include <algorithm>

namespace hooke {

template <class Real>
void ColliderRules<Real>::configure(const Scene& scene, std::size_t material_count) {
  const ContactTable table(scene.materials, scene.contacts);
  placed = {};
  pairs.clear();
  for (const Collider& collider : scene.colliders) {
    for (std::size_t m = 0; m < material_count; ++m) {
      pairs.push_back(
          PassRules<Real>::row_of(table.collider(m, collider.material), static_cast<Real>(scene.materials[m].radius)));
    }
  }
}

template <class Real>
void ColliderRules<Real>::place(const Scene& scene, std::span<const ColliderPose> poses, double reach,
                                ForcePass<Real>& pass) {
  placed = place_colliders<Real>(scene, poses, reach);
  pass.colliders = placed.all.data();
  pass.collider_of = placed.of.data();
  pass.collider_count = placed.all.size();
  pass.collider_pairs = pairs.data();
  if (placed.all.empty()) return;
  pass.near_colliders_from = placed.all[0].near_from;
  pass.near_colliders_to = placed.all[0].near_to;
  for (const PlacedCollider<Real>& collider : placed.all) {
    for (int axis = 0; axis < 3; ++axis) {
      Real &from = component(pass.near_colliders_from, axis), &to = component(pass.near_colliders_to, axis);
      from = std::min(from, component(collider.near_from, axis));
      to = std::max(to, component(collider.near_to, axis));
    }
  }
}

template struct ColliderRules<float>;
template struct ColliderRules<double>;

}  // namespace hooke
