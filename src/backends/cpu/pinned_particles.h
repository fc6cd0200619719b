// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/neighbours/layout.h"

namespace hooke {

/// Which particles are pinned still, by their index in memory. Takes no memory and no time where none is pinned.
class PinnedParticles {
  static constexpr std::size_t kLanes = kSliceLanes;

 public:
  /// None of `count` particles is pinned.
  void clear(std::size_t count) { lanes_.assign((count + kLanes - 1) / kLanes, 0); }
  /// Holds particle i.
  void hold(std::size_t i) {
    HOOKE_ASSERT(i / kLanes < lanes_.size(), i);
    lanes_[i / kLanes] = static_cast<std::uint16_t>(lanes_[i / kLanes] | 1U << i % kLanes);
  }

  /// Index i has another particle now, which is not pinned.
  void release(std::size_t i) {
    if (none()) return;
    lanes_[i / kLanes] = static_cast<std::uint16_t>(lanes_[i / kLanes] & ~(1U << i % kLanes));
  }

  bool none() const { return lanes_.empty(); }
  bool holds(std::size_t i) const { return !none() && (lanes_[i / kLanes] >> i % kLanes & 1U) != 0; }
  /// A bit for each of the 16 particles of a slice, one entry a slice; null where none is pinned.
  const std::uint16_t* lanes() const { return none() ? nullptr : lanes_.data(); }

 private:
  std::vector<std::uint16_t> lanes_;
};

}  // namespace hooke
