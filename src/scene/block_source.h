// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hooke/core/scene.h"
#include "hooke/scene/findings.h"
#include "hooke/scene/json_reader.h"
#include "hooke/scene/lattice.h"

namespace hooke::scene {

/// A block of particles as the scene writes it, with the box that it fills.
struct BlockSource {
  std::string path;    ///< in the scene: "particles[0].block"
  std::string lattice;  ///< "cubic", "hcp", "random"
  Box3d box;
  double spacing = 1;  ///< m, > 0
  std::optional<std::uint64_t> count;
  double jitter = 0;  ///< m, >= 0
  std::uint64_t seed = 1;
  UpDirection up;
};

/// Reads a block that has passed the schema; `radius` (m) is the radius of its material. Corners in the wrong order are
/// a finding, and then the result is empty.
std::optional<BlockSource> read_block(const Json& block, const std::string& path, const Scene& scene, double radius,
                                      Findings& findings);

/// Estimates how many particles a block will have, without making any.
double expected_count(const BlockSource& block);

/// The centres of a block's particles. Jitter wraps around at periodic faces. A count that does not fit is a finding
/// that says how many particles would fit.
std::vector<Vec3d> block_centres(const BlockSource& block, const Domain& domain, Findings& findings);

/// Of a block that is a lattice, not random: its number of sites, which its count may exceed; and `count` of its
/// particles' centres from number `first` on, the same as of block_centres().
std::uint64_t lattice_site_count(const BlockSource& block);
void append_lattice(const BlockSource& block, const Domain& domain, std::uint64_t first, std::uint64_t count,
                    std::vector<Vec3d>& centres);

}  // namespace hooke::scene
