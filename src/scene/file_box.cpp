// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/file_box.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hooke/core/scene.h"
#include "hooke/scene/particle_file.h"

namespace hooke::scene {

namespace {

// Whether the box has this length (m) along the axis, as far as programs write digits.
bool has_length(const FileBox& box, int axis, double length) {
  constexpr double kRounding = 1e-5;
  return std::abs(component(box.edge[static_cast<std::size_t>(axis)], axis) - length) <= kRounding * length;
}

// Axes that are periodic in the domain, and in the box as far as is known. An edge of 0 says nothing.
bool is_compared(const FileBox& box, const Domain& domain, int axis) {
  const auto a = static_cast<std::size_t>(axis);
  return domain.boundary[a] == Boundary::periodic && box.periodic[a] && component(box.edge[a], axis) != 0;
}

}  // namespace

bool FileBox::is_tilted() const {
  for (int row = 0; row < 3; ++row) {
    for (int axis = 0; axis < 3; ++axis) {
      if (axis != row && component(edge[static_cast<std::size_t>(row)], axis) != 0) return true;
    }
  }
  return false;
}

void check_box(const FileBox& box, const std::string& name, const Domain& domain, Findings& findings,
               std::vector<Finding>& warnings) {
  const std::string where = place_in_file(name, box.line, false);
  const bool periodic =
      std::find(domain.boundary.begin(), domain.boundary.end(), Boundary::periodic) != domain.boundary.end();
  if (box.is_tilted()) {
    if (periodic) {
      findings.add_elsewhere(where, "says that the box is tilted; a periodic domain has right angles");
    } else {
      warnings.push_back({where, "says that the box is tilted, which is passed over: positions are read as they are"});
    }
    return;
  }
  std::string differing;
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_compared(box, domain, axis) || has_length(box, axis, domain.length(axis))) continue;
    differing +=
        fmt::format("{}{:.7g} m along {}, where the domain has {:.7g} m", differing.empty() ? "" : ", ",
                    component(box.edge[static_cast<std::size_t>(axis)], axis), "xyz"[axis], domain.length(axis));
  }
  if (differing.empty()) return;
  findings.add_elsewhere(where,
                         fmt::format("says that the box is {}; a periodic domain must be of the same size", differing));
}

}  // namespace hooke::scene
