// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "hooke/core/rules.h"
#include "hooke/passes/force_pass.h"

namespace hooke {

/// A scene's rules, and tables derived from them that make the force pass and the neighbour search fast.
template <class Real>
class PassRules : public Rules<Real> {
 public:
  PassRules() = default;
  explicit PassRules(const Scene& scene);

  const ForceConstants<Real>& constants() const { return constants_; }

  /// Materials of similar reach share a level: the largest reach of each, ascending, m.
  const std::vector<double>& level_radius() const { return level_radius_; }
  const std::vector<std::size_t>& level_of() const { return level_of_; }  ///< by material

 private:
  void find_few();
  void find_levels();
  void find_clear_range(int axis);

  std::vector<FewMaterials<Real>> few_;  // none, or one
  std::vector<double> level_radius_;
  std::vector<std::size_t> level_of_;
  ForceConstants<Real> constants_;
};

extern template class PassRules<float>;
extern template class PassRules<double>;

}  // namespace hooke
