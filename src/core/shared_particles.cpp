// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/shared_particles.h"

#include <algorithm>
#include <cmath>

namespace hooke {

int Decomposition::owner(const Vec3d& x) const {
  for (int rank = 0; rank < static_cast<int>(boxes.size()); ++rank) {
    if (owns(rank, x)) return rank;
  }
  return kNobody;
}

bool Decomposition::is_near(int rank, const Vec3d& x, double reach) const {
  const Box3d& box = boxes[static_cast<std::size_t>(rank)];
  for (int axis = 0; axis < 3; ++axis) {
    double low = component(box.min, axis), high = component(box.max, axis);
    const double at = component(x, axis);
    if (domain.boundary[static_cast<std::size_t>(axis)] != Boundary::periodic) {
      if (!(at >= low - reach && at <= high + reach)) return false;
      continue;
    }
    low = std::max(low, component(domain.min, axis)) - reach;
    high = std::min(high, component(domain.max, axis)) + reach;
    const double period = component(domain.period(), axis);
    const auto is_between = [&](double at_image) { return at_image >= low && at_image <= high; };
    if (!is_between(at) && !is_between(at - period) && !is_between(at + period)) return false;
  }
  return true;
}

double FrameDisplacements::furthest_from(const Vec3d& displacement) const {
  if (none()) return 0;
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = component(displacement, axis);
    const double furthest = std::max(most[axis] - at, at + most[axis + 3]);
    sum += furthest * furthest;
  }
  return std::sqrt(sum);
}

}  // namespace hooke
