// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "hooke/core/triangle_mesh.h"

namespace hooke::scene {

// What programs leave behind in the meshes that they write: vertices that are there several times, slits that no one
// sees, facets that are there twice. All results depend on the order of vertices and triangles alone.

/// In a list of a vertex's new numbers: no triangle uses the vertex, and it is gone.
inline constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

/// Makes one of all vertices at the same place. Triangles that lose a corner by that go.
void merge_equal_vertices(TriangleMesh& mesh);

/// Makes one of vertices on edges of one triangle only that are nearer than a tolerance, and drops triangles that are
/// there already with the same corners in the same sense. The tolerance is a hundred-thousandth of the mesh's size, and
/// at most a tenth of the shortest of these edges; inside a closed surface nothing is welded. Says what was done in
/// `warnings`, each of which follows on the file's name. Returns the new number of each vertex.
std::vector<std::uint32_t> mend(TriangleMesh& mesh, std::vector<std::string>& warnings);

/// Drops the vertices that no triangle uses. Returns the new number of each vertex, or kUnused.
std::vector<std::uint32_t> drop_unused_vertices(TriangleMesh& mesh);

struct OpenEdges {
  std::size_t single = 0;  ///< edges of one triangle
  std::size_t odd = 0;  ///< edges of three triangles, or of a larger odd number
};

/// The edges at which a mesh is not closed: both counts are 0 where it encloses a space, whatever the sense of its
/// triangles.
OpenEdges open_edges(const TriangleMesh& mesh);

}  // namespace hooke::scene
