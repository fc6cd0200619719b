// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <vector>

#include "hooke/backends/cpu/attraction_sums.h"
#include "hooke/backends/cpu/id_table.h"
#include "hooke/backends/cpu/particle_record.h"
#include "hooke/base/exact_sum.h"
#include "hooke/base/huge_pages.h"
#include "hooke/base/parallel.h"
#include "hooke/core/scene.h"

namespace hooke {

/// The attraction of a scene for the CPU back end: forces on its records, and what they do.
template <class Real>
class AttractionForces {
  using Record = ParticleRecord<Real>;

 public:
  void configure(const Scene& scene, const AttractionLoops<Real>& loops) {
    attracts_ = scene.attraction.has_value();
    if (!attracts_) return;
    units_ = attraction_units(scene);
    sums_.configure(*scene.attraction, softening_squared(scene) / (units_.length * units_.length), loops);
    mass_.clear();
    weight_.clear();
    for (const Material& m : scene.materials) {
      mass_.push_back(static_cast<Real>(m.mass / units_.mass));
      weight_.push_back(m.mass * scene.attraction->constant);
    }
  }

  bool empty() const { return !attracts_; }

  /// Sums the forces on the first `count` records, of which `alive` are somewhere.
  void apply(const LargeVector<Record>& records, std::size_t count, std::size_t alive, const IdTable& ids) {
    gather(records, count, alive);
    force_.assign(records.size(), {Real(0), Real(0), Real(0)});
    sums_.accelerations(points_, ids, force_.data());
    const double per_unit = units_.mass / (units_.length * units_.length);
    parallel_ranges(count, kRange, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        force_[i] = static_cast<Real>(weight_[material_of(records[i])] * per_unit) * force_[i];
      }
    });
  }

  /// N, in the order of the records; as many as there are, those in no use included.
  const Vec3<Real>* forces() const { return force_.data(); }

  /// Potential energy of all with each other, J.
  double energy(const LargeVector<Record>& records, std::size_t count, std::size_t alive, const IdTable& ids) {
    gather(records, count, alive);
    std::vector<double> potential(count, 0);
    sums_.potentials(points_, ids, potential.data());
    const double per_unit = units_.mass / units_.length;
    ExactSum energy;
    for (std::size_t i = 0; i < count; ++i) {
      energy.add(0.5 * (weight_[material_of(records[i])] * per_unit) * potential[i]);
    }
    return energy.value();
  }

 private:
  static constexpr std::size_t kRange = 4096;

  static std::size_t material_of(const Record& p) { return static_cast<std::size_t>(p.material); }

  void gather(const LargeVector<Record>& records, std::size_t count, std::size_t alive) {
    points_.resize(alive);
    if (alive == count) {
      parallel_ranges(count, kRange, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) points_[i] = point_of(records, i);
      });
      return;
    }
    std::size_t at = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_nowhere(records[i])) points_[at++] = point_of(records, i);
    }
  }

  AttractionPoint<Real> point_of(const LargeVector<Record>& records, std::size_t i) const {
    const Record& p = records[i];
    const Vec3<Real> x = static_cast<Real>(1 / units_.length) * p.x;
    return {{x.x, x.y, x.z, mass_[material_of(p)]}, rank_of(p.rank), static_cast<std::uint32_t>(i)};
  }

  bool attracts_ = false;
  AttractionUnits units_;
  std::vector<Real> mass_;      // by material, in units
  std::vector<double> weight_;  // by material: mass times G
  AttractionSums<Real> sums_;
  LargeVector<AttractionPoint<Real>> points_;
  LargeVector<Vec3<Real>> force_;
};

}  // namespace hooke
