// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hooke/core/shapes.h"
#include "hooke/scene/findings.h"
#include "hooke/scene/json_reader.h"
#include "hooke/scene/load_scene.h"

namespace hooke {

/// Where the files of shapes are, and what their distance fields must serve.
struct ShapeFiles {
  std::filesystem::path folder;  ///< of the scene
  bool allow_outside = false;    ///< files may lie elsewhere
  double smallest_radius = 1;    ///< of particles, m, > 0: features of this size are kept
  double reach = 1;              ///< m, > 0: as far from surfaces as distances are needed
  std::vector<Finding>* warnings = nullptr;
  std::vector<SceneFile>* used = nullptr;  ///< gets every file that is read
};

/// The shape that a "shape" object of a scene at the path `where` describes (schema/scene.json, definition "shape"):
/// of colliders and whatever else takes a part of space. Nothing, with findings, where there is something wrong; what
/// the schema has found wrong is passed over.
std::optional<Shape> read_shape(const Json& shape, const std::string& where, const ShapeFiles& files,
                                Findings& findings);

}  // namespace hooke
