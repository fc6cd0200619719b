// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/base/vec3.h"

namespace hooke {

/// Triangles that share their corners.
struct ClothMesh {
  std::vector<Vec3d> position;           ///< m; corners in the order of the file
  std::vector<std::uint32_t> triangles;  ///< three corners each
};

/// Reads the corners and faces of a Wavefront OBJ file and skips everything else. Polygons are cut into triangles from
/// their first corner. The error's only finding has an empty `where`.
Expected<ClothMesh> read_cloth_mesh(const std::filesystem::path& file);

}  // namespace hooke
