// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "hooke/base/expected.h"
#include "hooke/core/triangle_mesh.h"

namespace hooke {

/// Reads the triangles of an OBJ, STL or PLY file, in the file's own units; polygons are cut into triangles, vertices
/// at the very same place become one, and triangles without area drop out. Nothing else that the file names (materials,
/// pictures) is opened. The error's only finding has an empty `where`.
Expected<TriangleMesh> read_mesh(const std::filesystem::path& file);

/// How many edges have an odd number of triangles at them: 0 where the mesh encloses a space, whichever way its
/// triangles are turned.
std::size_t count_open_edges(const TriangleMesh& mesh);

}  // namespace hooke
