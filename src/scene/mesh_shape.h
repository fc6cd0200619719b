// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "hooke/scene/shape_reader.h"

namespace hooke {

/// The mesh that a "mesh" object of a scene at the path `where` describes: read, scaled, turned, moved, and its
/// distance field made. Findings where it can't be had.
std::optional<MeshShape> read_mesh_shape(const Json& json, const std::string& where, const ShapeFiles& files,
                                         Findings& findings);

}  // namespace hooke
