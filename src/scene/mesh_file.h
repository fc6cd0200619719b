// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "hooke/base/expected.h"
#include "hooke/core/triangle_mesh.h"

namespace hooke {

/// Reads the triangles of an OBJ, STL or PLY file, in the file's own units. Polygons are cut into triangles, vertices
/// at the same position are merged, and triangles without area are dropped. Opens no other file that this one names
/// (materials, pictures). The error's only finding has an empty `where`.
Expected<TriangleMesh> read_mesh(const std::filesystem::path& file);

/// Number of edges with an odd number of triangles: 0 where the mesh encloses a space, whatever the orientation of its
/// triangles.
std::size_t count_open_edges(const TriangleMesh& mesh);

}  // namespace hooke
