// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/materials.h"

namespace hooke {

ContactCoefficients<double> mix(const ContactCoefficients<double>& a, const ContactCoefficients<double>& b) {
  const double stiffness_sum = a.stiffness + b.stiffness;
  // k1 (k2 / (k1 + k2)) and not (k1 k2) / (k1 + k2): the product of two large stiffnesses could overflow.
  const double stiffness = stiffness_sum > 0 ? 2 * (a.stiffness * (b.stiffness / stiffness_sum)) : 0;
  return {stiffness, (a.shear + b.shear) / 2, (a.damping + b.damping) / 2};
}

ContactTable::ContactTable(std::span<const Material> materials, std::span<const ContactEntry> entries) {
  const std::size_t n = materials.size();
  pairs_.resize(n * n);
  wall_.resize(n);
  for (std::size_t a = 0; a < n; ++a) {
    wall_[a] = materials[a].contact;
    for (std::size_t b = 0; b < n; ++b) {
      pairs_[a * n + b] = a == b ? materials[a].contact : mix(materials[a].contact, materials[b].contact);
    }
  }
  for (const ContactEntry& entry : entries) {
    if (entry.b == ContactEntry::kWall) {
      wall_[entry.a] = entry.coefficients;
    } else {
      pairs_[entry.a * n + entry.b] = entry.coefficients;
      pairs_[entry.b * n + entry.a] = entry.coefficients;
    }
  }
}

}  // namespace hooke
