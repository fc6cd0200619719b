// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "hooke/backends/cpu/force_pass.h"
#include "hooke/core/scene.h"

namespace hooke {

/// A scene's rules as the force pass and the neighbour search want them.
template <class Real>
struct PassRules {
  std::vector<PairRow<Real>> pairs;  ///< materials squared
  std::vector<PairRow<Real>> wall_pairs;  ///< a material each
  std::vector<MaterialRow<Real>> materials;
  std::vector<FewMaterials<Real>> few;  ///< none, or one
  double largest_radius = 0;  ///< of all particles, m
  double largest_touching = 0, smallest_radius = 1;  ///< of those that touch others, m
  bool all_interact = true;  ///< all materials' particles touch others
  double widest_range = 0;  ///< m: particles act on each other, and walls on them, across gaps up to this
  double rounding = 0;  ///< m, of displacements across a periodic axis
  std::vector<double> level_radius;  ///< m: materials of similar reach share a level; the largest of each, ascending
  std::vector<std::size_t> level_of;  ///< by material
  ForcePass<Real> pass;  ///< all but the buffers

  /// How far a particle reaches, m: two act on each other no further apart than the sum.
  double reach_of(std::size_t material) const { return materials[material].radius + widest_range / 2; }
  double largest_reach() const { return largest_touching + widest_range / 2; }

  static PairRow<Real> row_of(const ContactLaw<double>& law, Real reach);
  void configure(const Scene& scene);

 private:
  static Real real(double value) { return static_cast<Real>(value); }

  void configure_materials(const Scene& scene);
  void configure_few();
  void configure_levels();
  void configure_domain(const Domain& domain);
  void find_clear_range(int axis);

  std::vector<char> interacts_;  // by material
  double smallest_of_all_ = 1;  // radius, m
};

extern template struct PassRules<float>;
extern template struct PassRules<double>;

}  // namespace hooke
