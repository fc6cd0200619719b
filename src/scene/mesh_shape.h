// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "hooke/scene/shape_reader.h"

namespace hooke::scene {

/// Makes the mesh that the "mesh" object at the path `where` of a scene describes: reads, scales, turns and moves it
/// and makes its distance field. Findings where that fails.
std::optional<MeshShape> read_mesh_shape(const Json& json, const std::string& where, const ShapeFiles& files,
                                         Findings& findings);

}  // namespace hooke::scene
