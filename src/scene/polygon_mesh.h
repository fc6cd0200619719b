// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "hooke/core/triangle_mesh.h"
#include "hooke/scene/file_scanner.h"

namespace hooke::scene {

/// Vertices and faces in the order of a file. Readers check every index before they put it here.
struct PolygonMesh {
  std::vector<Vec3d> vertices;
  std::vector<std::uint32_t> corners;  ///< vertices of the faces, face by face, at least three each
  std::vector<std::size_t> ends;       ///< of each face: where its corners end
  std::vector<std::string> warnings;   ///< about the file; each follows on its name: "holds 7 bytes ..."
  bool binary = false;                 ///< places in the file are bytes, not lines
};

/// Vertices of a mesh have 32-bit numbers.
inline constexpr std::uint64_t kMostVertices = std::numeric_limits<std::uint32_t>::max();

// One reader per format, each in its own file. They throw FileFault; `binary` is set before the first place that is a
// byte.
void read_obj(FileScanner& in, PolygonMesh& mesh);
void read_stl(FileScanner& in, PolygonMesh& mesh);
void read_ply_mesh(FileScanner& in, PolygonMesh& mesh);

/// Cuts the faces into triangles: convex ones from their first corner, others ear by ear. Throws FileFault where a face
/// that is not convex has too many corners for that.
TriangleMesh cut_into_triangles(PolygonMesh&& polygons);

}  // namespace hooke::scene
