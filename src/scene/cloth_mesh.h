// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/triangle_mesh.h"

namespace hooke::scene {

/// A sheet of triangles that share their corners, in the order of the file.
struct ClothMesh {
  TriangleMesh mesh;
  std::vector<std::uint32_t> vertex;  ///< of each corner of the file: its vertex, or kUnused (mesh_repair.h)
  std::vector<std::string> warnings;  ///< each follows on the file's name
};

/// Reads a Wavefront OBJ file as a cloth. Polygons are cut into triangles. Corners at the same place on open edges, as
/// programs write seams, are welded; those that no face uses are left out. The error's only finding has an empty
/// `where`.
Expected<ClothMesh> read_cloth_mesh(const std::filesystem::path& file);

}  // namespace hooke::scene
