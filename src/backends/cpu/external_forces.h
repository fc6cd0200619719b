// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hooke/backends/cpu/particle_state.h"
#include "hooke/base/huge_pages.h"
#include "hooke/base/parallel.h"

namespace hooke {

/// Forces that the caller gives to particles by their ids, as a column by slot.
template <class Real>
class ExternalForces {
 public:
  bool empty() const { return ids_.empty(); }

  void clear() {
    ids_.clear();
    force_.clear();
  }

  /// Replaces all forces (N); call particles.find_slots() before. Returns the first id that no particle has, if there
  /// is one; then nothing changes.
  std::optional<std::uint64_t> set(const ParticleState<Real>& particles, std::span<const std::uint64_t> ids,
                                   std::span<const Vec3d> forces) {
    const auto unknown =
        std::find_if(ids.begin(), ids.end(), [&](std::uint64_t id) { return particles.slot_of(id) == kNoSlot; });
    if (unknown != ids.end()) return *unknown;
    ids_.assign(ids.begin(), ids.end());
    force_.clear();
    for (const Vec3d& force : forces) force_.push_back(vec_cast<Real>(force));
    is_laid_out_ = false;
    return std::nullopt;
  }

  /// N, in the order of the records; 0 for particles without a force and for unused slots.
  const Vec3<Real>* column(const ParticleState<Real>& particles) {
    if (is_laid_out_ && changes_ == particles.changes()) return column_.data();
    particles.find_slots();
    column_.resize(particles.records.size());
    parallel_ranges(column_.size(), kTile, [&](std::size_t first, std::size_t last) {
      std::fill(column_.begin() + static_cast<std::ptrdiff_t>(first),
                column_.begin() + static_cast<std::ptrdiff_t>(last), Vec3<Real>{Real(0), Real(0), Real(0)});
    });
    parallel_ranges(ids_.size(), kTile, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        const std::size_t slot = particles.slot_of(ids_[k]);
        if (slot != kNoSlot) column_[slot] = force_[k];
      }
    });
    changes_ = particles.changes();
    is_laid_out_ = true;
    return column_.data();
  }

 private:
  static constexpr std::size_t kNoSlot = ParticleState<Real>::kNoSlot;

  std::vector<std::uint64_t> ids_;
  std::vector<Vec3<Real>> force_;  // N, of each
  LargeVector<Vec3<Real>> column_;
  std::uint64_t changes_ = 0;  // particles.changes() when the column was laid out
  bool is_laid_out_ = false;
};

}  // namespace hooke
