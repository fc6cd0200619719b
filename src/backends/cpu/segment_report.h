// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "hooke/backends/cpu/force_pass.h"
#include "hooke/core/sums.h"
#include "hooke/neighbours/neighbour_list.h"

namespace hooke {

/// Where the groups of one segment report what the force pass found out beside their new state.
struct SegmentReport {
  std::array<unsigned char, NeighbourList::kGroups> notes;  // GroupNote bits
  std::array<std::uint16_t, NeighbourList::kGroups> far;    // a bit a particle
  std::array<ExactParts, PassSum::count> sums;

  void clear() {
    notes.fill(0);
    far.fill(0);
    for (ExactParts& parts : sums) parts.count = 0;
  }

  void add_to(StepSums& step) const {
    constexpr std::pair<PassSum::Power, Cause> kPowers[] = {{PassSum::contact_spring, Cause::contact_spring},
                                                            {PassSum::contact_shear, Cause::contact_shear},
                                                            {PassSum::contact_damping, Cause::contact_damping},
                                                            {PassSum::contact_friction, Cause::contact_friction},
                                                            {PassSum::drag, Cause::drag},
                                                            {PassSum::gravity, Cause::gravity},
                                                            {PassSum::wall, Cause::wall},
                                                            {PassSum::collider, Cause::collider}};
    for (const auto& [power, cause] : kPowers) {
      add(power, step.power[cause]);
      add(PassSum::next + power, step.next_power[cause]);
    }
    for (int axis = 0; axis < 3; ++axis) {
      add(PassSum::wall_force + axis, step.wall_force[axis]);
      add(PassSum::collider_force + axis, step.collider_force[axis]);
      add(PassSum::drag_force + axis, step.drag_force[axis]);
    }
  }

 private:
  void add(int sum, ExactSum& to) const {
    const ExactParts& parts = sums[static_cast<std::size_t>(sum)];
    to.add(parts.values, parts.count);
  }
};

}  // namespace hooke
