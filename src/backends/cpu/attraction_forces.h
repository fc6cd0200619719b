// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "hooke/backends/cpu/attraction_sums.h"
#include "hooke/backends/cpu/particle_slots.h"
#include "hooke/base/exact_sum.h"
#include "hooke/base/huge_pages.h"
#include "hooke/core/scene.h"
#include "hooke/passes/id_table.h"
#include "hooke/passes/particle_record.h"

namespace hooke {

/// The attraction of a scene for the CPU back end: forces on its records, and their energy.
template <class Real>
class AttractionForces {
  using Record = ParticleRecord<Real>;

 public:
  void configure(const Scene& scene, const AttractionLoops<Real>& loops);

  bool empty() const { return !attracts_; }

  /// Sums the forces on the particles, of which there are `alive`, by them and by the ghosts.
  void apply(const LargeVector<Record>& records, const ParticleSlots& slots, std::size_t alive, const IdTable& ids);

  /// N, in the order of the records; one for each record, unused records included.
  const Vec3<Real>* forces() const { return force_.data(); }

  /// Half of the potential energy of each particle, J: of all pairs, where there are no ghosts.
  ExactSum energy(const LargeVector<Record>& records, const ParticleSlots& slots, std::size_t alive,
                  const IdTable& ids);

 private:
  static constexpr std::size_t kRange = 4096;

  static std::size_t material_of(const Record& p) { return static_cast<std::size_t>(p.material); }

  void gather(const LargeVector<Record>& records, const ParticleSlots& slots, std::size_t alive);

  AttractionPoint<Real> point_of(const LargeVector<Record>& records, std::size_t i) const {
    const Record& p = records[i];
    const Vec3<Real> x = static_cast<Real>(1 / units_.length) * p.x;
    return {{x.x, x.y, x.z, mass_[material_of(p)]}, id_index_of(p.id_index), static_cast<std::uint32_t>(i)};
  }

  bool attracts_ = false;
  AttractionUnits units_;
  std::vector<Real> mass_;      // by material, in units
  std::vector<double> weight_;  // by material: mass times G
  AttractionSums<Real> sums_;
  LargeVector<AttractionPoint<Real>> points_;
  LargeVector<Vec3<Real>> force_;
};

extern template class AttractionForces<float>;
extern template class AttractionForces<double>;

}  // namespace hooke
