// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "hooke/core/sums.h"
#include "hooke/neighbours/neighbour_list.h"
#include "hooke/passes/exact_parts.h"
#include "hooke/passes/force_pass.h"

namespace hooke {

/// What the force pass reports of the slices of one tile beside their new state.
struct TileReport {
  std::array<unsigned char, NeighbourList::kSlices> notes;  // SliceNote bits
  std::array<std::uint16_t, NeighbourList::kSlices> far;    // a bit a particle
  std::array<ExactParts, PassSum::kCount> sums;

  void clear() {
    notes.fill(0);
    far.fill(0);
    for (ExactParts& parts : sums) parts.count = 0;
  }

  void add_to(StepSums& step) const;

 private:
  void add(int sum, ExactSum& to) const;
};

}  // namespace hooke
