// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "hooke/core/particles.h"
#include "hooke/core/placed_fields.h"
#include "hooke/core/scene.h"
#include "hooke/physics/periodic.h"

namespace hooke {

/// The forces of a scene's fields at `time` (s) on each particle, N, spelled out: field by field, first on the particle
/// itself, then on the triangles of cloths in the order of their surfaces. Empty where there are no fields.
inline std::vector<Vec3d> field_forces(const Scene& scene, const ParticleSet& p, double time) {
  std::vector<Vec3d> force(scene.fields.empty() ? 0 : p.size(), Vec3d{0, 0, 0});
  for (const PlacedField<double>& field : place_fields<double>(scene, time)) {
    for (std::size_t i = 0; i < force.size(); ++i) {
      const Vec3d& x = p.position[i];
      if (field.acts_on(p.material[i], x)) force[i] += field.force(p.material[i], x, p.velocity[i]);
    }
    if (!field.blows_on_sheets() || !scene.structure) continue;
    for (const Surface& surface : scene.structure->surfaces) {
      for (std::size_t t = 0; t < surface.triangles.size(); t += 3) {
        const auto corner = [&](std::size_t k) { return p.find(surface.particles[surface.triangles[t + k]]); };
        const std::size_t a = corner(0), b = corner(1), c = corner(2);
        if (a == p.size() || b == p.size() || c == p.size()) continue;
        const Vec3d edge_1 = nearest_displacement(p.position[b], p.position[a], scene.domain.period());
        const Vec3d edge_2 = nearest_displacement(p.position[c], p.position[a], scene.domain.period());
        const Vec3d middle = p.position[a] + (1.0 / 3) * (edge_1 + edge_2);
        if (!field.acts_on(p.material[a], middle)) continue;
        const Vec3d v = (1.0 / 3) * ((p.velocity[a] + p.velocity[b]) + p.velocity[c]);
        const Vec3d third = field.force_on_corner(middle, edge_1, edge_2, v);
        for (const std::size_t i : {a, b, c}) force[i] += third;
      }
    }
  }
  return force;
}

}  // namespace hooke
