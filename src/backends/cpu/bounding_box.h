// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <mutex>

#include "hooke/backends/cpu/id_table.h"
#include "hooke/backends/cpu/particle_record.h"
#include "hooke/base/parallel.h"
#include "hooke/core/backend.h"

namespace hooke {

/// The box [min, max] (m) around the first `count` particles, inside out where there are none; or which of them is at
/// no place.
template <class Real>
Condition bounding_box(const ParticleRecord<Real>* records, std::size_t count, const IdTable& ids, Vec3d& min,
                       Vec3d& max) {
  constexpr std::size_t kGrain = 1024;
  min = {INFINITY, INFINITY, INFINITY};
  max = {-INFINITY, -INFINITY, -INFINITY};
  Condition condition;
  std::mutex mutex;
  parallel_ranges(count, kGrain, [&](std::size_t first, std::size_t last) {
    Vec3<Real> low = vec_cast<Real>(Vec3d{INFINITY, INFINITY, INFINITY}), high = -low;
    Condition found;
    for (std::size_t i = first; i < last; ++i) {
      const ParticleRecord<Real>& p = records[i];
      if (is_vacant(p)) continue;
      for (int axis = 0; axis < 3; ++axis) {
        const Real x = component(p.x, axis);
        if (!(std::abs(x) < static_cast<Real>(kFurthest))) {
          const auto kind = std::isfinite(x) ? Condition::Kind::grid_overflow : Condition::Kind::not_finite;
          found = Condition::first(found, {kind, ids[rank_of(p.rank)], 0, 0});
        }
        component(low, axis) = std::min(component(low, axis), x);
        component(high, axis) = std::max(component(high, axis), x);
      }
    }
    const std::lock_guard lock(mutex);
    condition = Condition::first(condition, found);
    for (int axis = 0; axis < 3; ++axis) {
      component(min, axis) = std::min<double>(component(min, axis), component(low, axis));
      component(max, axis) = std::max<double>(component(max, axis), component(high, axis));
    }
  });
  return condition;
}

}  // namespace hooke
