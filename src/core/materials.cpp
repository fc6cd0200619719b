// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/materials.h"

#include <algorithm>

#include "hooke/base/assert.h"

namespace hooke {

ContactCoefficients<double> mix(const ContactCoefficients<double>& a, const ContactCoefficients<double>& b) {
  const double stiffness_sum = a.stiffness + b.stiffness;
  // k1 (k2 / (k1 + k2)) and not (k1 k2) / (k1 + k2): the product of two large stiffnesses could overflow.
  const double stiffness = stiffness_sum > 0 ? 2 * (a.stiffness * (b.stiffness / stiffness_sum)) : 0;
  return {stiffness, (a.shear + b.shear) / 2, (a.damping + b.damping) / 2};
}

SurfaceCoefficients<double> mix(const SurfaceCoefficients<double>& a, const SurfaceCoefficients<double>& b) {
  return {std::min(a.friction, b.friction), std::min(a.tension, b.tension), std::min(a.cohesion, b.cohesion),
          std::min(a.range, b.range)};
}

ContactTable::ContactTable(std::span<const Material> materials, std::span<const ContactEntry> entries) {
  const std::size_t n = materials.size();
  pairs_.resize(n * n);
  wall_.resize(n);
  for (std::size_t a = 0; a < n; ++a) {
    const Material& of_a = materials[a];
    wall_[a] = {of_a.contact, of_a.surface};
    for (std::size_t b = 0; b < n; ++b) {
      pairs_[a * n + b] =
          a == b ? wall_[a]
                 : ContactLaw<double>{mix(of_a.contact, materials[b].contact), mix(of_a.surface, materials[b].surface)};
    }
  }
  for (const ContactEntry& entry : entries) {
    HOOKE_ASSERT(entry.a < n && (entry.b < n || entry.b == ContactEntry::kWall), entry.a, entry.b, n);
    const ContactLaw<double> law{entry.coefficients, entry.surface};
    if (entry.b == ContactEntry::kWall) {
      wall_[entry.a] = law;
    } else {
      pairs_[entry.a * n + entry.b] = law;
      pairs_[entry.b * n + entry.a] = law;
    }
  }
  for (const auto* laws : {&pairs_, &wall_}) {
    for (const ContactLaw<double>& law : *laws) {
      linear_ = linear_ && !law.surface.act();
      widest_range_ = std::max(widest_range_, law.surface.range);
    }
  }
}

}  // namespace hooke
