// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/segment_report.h"

#include <utility>

namespace hooke {

void SegmentReport::add_to(StepSums& step) const {
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

void SegmentReport::add(int sum, ExactSum& to) const {
  const ExactParts& parts = sums[static_cast<std::size_t>(sum)];
  to.add(parts.values, parts.count);
}

}  // namespace hooke
