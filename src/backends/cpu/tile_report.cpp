// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/tile_report.h"

namespace hooke {

void TileReport::add_to(StepSums& step) const {
  for (std::size_t cause = 0; cause < kPassCauses; ++cause) {
    add(static_cast<int>(cause), step.power.of[cause]);
    add(PassSum::kNext + static_cast<int>(cause), step.next_power.of[cause]);
  }
  for (int axis = 0; axis < 3; ++axis) {
    add(PassSum::kWallForce + axis, step.wall_force[axis]);
    add(PassSum::kColliderForce + axis, step.collider_force[axis]);
    add(PassSum::kDragForce + axis, step.drag_force[axis]);
  }
}

void TileReport::add(int sum, ExactSum& to) const {
  const ExactParts& parts = sums[static_cast<std::size_t>(sum)];
  to.add(parts.values, parts.count);
}

}  // namespace hooke
