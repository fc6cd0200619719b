// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <mutex>

#include "hooke/base/box3.h"
#include "hooke/base/parallel.h"
#include "hooke/core/backend.h"
#include "hooke/passes/id_table.h"
#include "hooke/passes/particle_record.h"

namespace hooke {

/// Sets `box` to the box (m) around those of the first `count` particles that `counts`, Box3d::none() without any.
/// Returns the first particle whose position is not finite or too far out.
template <class Real, class Counts>
Condition bounding_box(const ParticleRecord<Real>* records, std::size_t count, const IdTable& ids, const Counts& counts,
                       Box3d& box) {
  constexpr std::size_t kGrain = 1024;
  box = Box3d::none();
  Condition condition;
  std::mutex mutex;
  parallel_ranges(count, kGrain, [&](std::size_t first, std::size_t last) {
    Box3<Real> part = Box3<Real>::none();
    Condition found;
    for (std::size_t i = first; i < last; ++i) {
      const ParticleRecord<Real>& p = records[i];
      if (is_vacant(p) || !counts(p)) continue;
      for (int axis = 0; axis < 3; ++axis) {
        const Real x = component(p.x, axis);
        if (!(std::abs(x) < static_cast<Real>(kFurthest))) {
          const auto kind = std::isfinite(x) ? Condition::Kind::grid_overflow : Condition::Kind::not_finite;
          found = Condition::first(found, {kind, ids[id_index_of(p.id_index)], 0, 0});
        }
      }
      part.add(p.x);
    }
    const std::lock_guard lock(mutex);
    condition = Condition::first(condition, found);
    box.add({vec_cast<double>(part.min), vec_cast<double>(part.max)});
  });
  return condition;
}

}  // namespace hooke
