// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hooke/backends/cpu/attraction_tree.h"
#include "hooke/base/vec3.h"
#include "hooke/core/attraction.h"
#include "hooke/passes/id_table.h"

namespace hooke {

/// The pull of all particles on each one, in parallel: pair by pair, or by the tree. Its bits depend on positions,
/// masses and ids alone. In the scene's units of attraction; the caller multiplies by G.
template <class Real>
class AttractionSums {
 public:
  /// `softening2` > 0, a length squared.
  void configure(const Attraction& attraction, double softening2, const AttractionLoops<Real>& loops);

  /// a[p.index] = the pull on p, a mass over a length squared, for the points of an index below `end`. Reorders
  /// `points`; `ids` has the ids by id index.
  void accelerations(std::span<AttractionPoint<Real>> points, std::size_t end, const IdTable& ids, Vec3<Real>* a);

  /// potential[p.index] = the potential of all other particles at p, a mass over a length, < 0.
  void potentials(std::span<AttractionPoint<Real>> points, std::size_t end, const IdTable& ids, double* potential);

 private:
  class Walk;

  template <class Take>
  void sum_directly(std::span<AttractionPoint<Real>> points, std::size_t end, const IdTable& ids,
                    typename AttractionLoops<Real>::Function by_particles, const Take& take);
  template <class Take>
  void sum_by_tree(std::span<AttractionPoint<Real>> points, std::size_t end,
                   typename AttractionLoops<Real>::Function by_particles,
                   typename AttractionLoops<Real>::Function by_cells, const Take& take);
  std::vector<double> estimate_pulls(std::span<const std::uint32_t> groups) const;

  Attraction attraction_;
  Real softening2_{};
  AttractionLoops<Real> loops_{};
  AttractionTree<Real> tree_;
  LargeVector<AttractionSource<Real>> sources_;
};

extern template class AttractionSums<float>;
extern template class AttractionSums<double>;

}  // namespace hooke
