// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hooke/base/vec3.h"
#include "hooke/scene/findings.h"

namespace hooke {
struct Domain;
}

namespace hooke::scene {

/// The box that a file of particles gives them.
struct FileBox {
  std::array<Vec3d, 3> edge{};  ///< m
  std::array<bool, 3> periodic{true, true, true};  ///< false across an axis only where the file says so
  std::uint64_t line = 0;       ///< of the file that says it

  /// Whether its edges are not along the axes.
  bool is_tilted() const;
};

/// Compares the box of the file `name` with the domain that its particles enter. A finding where the domain is periodic
/// and the box is tilted or of another size, since then no particle has the neighbours that it had; a tilted box in
/// another domain is a warning.
void check_box(const FileBox& box, const std::string& name, const Domain& domain, Findings& findings,
               std::vector<Finding>& warnings);

}  // namespace hooke::scene
