// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/lammps_box.h"

#include <algorithm>

namespace hooke::io {

Domain lammps_box(const Snapshot& snapshot, const std::vector<MaterialInfo>& materials, const Scene* scene) {
  const ParticleSet& p = snapshot.particles;
  Domain box = scene ? scene->domain : Domain{};
  if (!scene && !p.empty()) box.min = box.max = p.position[0];
  for (int axis = 0; axis < 3; ++axis) {
    if (box.boundary[static_cast<std::size_t>(axis)] == Boundary::periodic) continue;
    const double domain_min = component(box.min, axis), domain_max = component(box.max, axis);
    double& min = component(box.min, axis);
    double& max = component(box.max, axis);
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double x = component(p.position[i], axis), radius = materials[p.material[i]].radius;
      if (!scene || x <= domain_min) min = std::min(min, x - radius);
      if (!scene || x >= domain_max) max = std::max(max, x + radius);
    }
  }
  return box;
}

}  // namespace hooke::io
