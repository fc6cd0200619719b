// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "hooke/scene/mesh_file.h"
#include "hooke/volumes/mesh_field.h"
#include "support/made_meshes.h"

namespace hooke::test {

inline MeshShape shape_of(const TriangleMesh& mesh, double cell, double reach) {
  MeshShape shape;
  shape.surface = std::make_shared<const TriangleMesh>(mesh);
  shape.field = std::make_shared<const DistanceField>(
      volumes::make_distance_field(mesh, {cell, reach, scene::count_open_edges(mesh) == 0}).value());
  return shape;
}

}  // namespace hooke::test
