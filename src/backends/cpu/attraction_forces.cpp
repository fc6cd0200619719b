// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/attraction_forces.h"

#include "hooke/base/exact_sum.h"
#include "hooke/base/parallel.h"

namespace hooke {

template <class Real>
void AttractionForces<Real>::configure(const Scene& scene, const AttractionLoops<Real>& loops) {
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

template <class Real>
void AttractionForces<Real>::apply(const LargeVector<Record>& records, const ParticleSlots& slots, std::size_t alive,
                                   const IdTable& ids) {
  const std::size_t count = slots.end();
  gather(records, slots, alive);
  force_.assign(records.size(), {Real(0), Real(0), Real(0)});
  sums_.accelerations(points_, count, ids, force_.data());
  const double per_unit = units_.mass / (units_.length * units_.length);
  parallel_ranges(count, kRange, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      force_[i] = static_cast<Real>(weight_[material_of(records[i])] * per_unit) * force_[i];
    }
  });
}

template <class Real>
ExactSum AttractionForces<Real>::energy(const LargeVector<Record>& records, const ParticleSlots& slots,
                                        std::size_t alive, const IdTable& ids) {
  const std::size_t count = slots.end();
  gather(records, slots, alive);
  std::vector<double> potential(count, 0);
  sums_.potentials(points_, count, ids, potential.data());
  const double per_unit = units_.mass / units_.length;
  ExactSum energy;
  for (std::size_t i = 0; i < count; ++i) {
    energy.add(0.5 * (weight_[material_of(records[i])] * per_unit) * potential[i]);
  }
  return energy;
}

template <class Real>
void AttractionForces<Real>::gather(const LargeVector<Record>& records, const ParticleSlots& slots, std::size_t alive) {
  points_.resize(alive + (slots.ghost_end() - slots.first_ghost()));
  std::size_t at = 0;
  const auto add = [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      if (!is_vacant(records[i])) points_[at++] = point_of(records, i);
    }
  };
  if (alive == slots.end()) {
    at = alive;
    parallel_ranges(alive, kRange, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) points_[i] = point_of(records, i);
    });
  } else {
    add(0, slots.end());
  }
  add(slots.first_ghost(), slots.ghost_end());
  points_.resize(at);
}

template class AttractionForces<float>;
template class AttractionForces<double>;

}  // namespace hooke
