// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/triangle_mesh.h"

namespace hooke::scene {

/// Reads the triangles of an OBJ, STL or PLY file, in the file's own units and double precision. Polygons are cut into
/// triangles, vertices at the same place are merged, slits welded and doubled triangles dropped (mesh_repair.h). Opens
/// no other file that this one names (materials, pictures). Warnings and the error's only finding, which has an empty
/// `where`, follow on the file's name: "holds no faces".
Expected<TriangleMesh> read_mesh(const std::filesystem::path& file, std::vector<std::string>* warnings = nullptr);

/// Reads an OBJ file, whatever its name, and cuts its polygons into triangles; vertices stay as they are in the file.
Expected<TriangleMesh> read_obj_triangles(const std::filesystem::path& file);

/// Number of edges with an odd number of triangles: 0 where the mesh encloses a space, whatever the orientation of its
/// triangles.
std::size_t count_open_edges(const TriangleMesh& mesh);

}  // namespace hooke::scene
