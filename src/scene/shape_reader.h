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

namespace hooke::scene {

/// Where the files of shapes are, and what their distance fields are needed for.
struct ShapeFiles {
  std::filesystem::path folder;  ///< of the scene
  bool allow_outside = false;    ///< files may lie elsewhere
  double smallest_radius = 1;    ///< of particles, m, > 0: distance fields keep features of this size
  double reach = 1;              ///< m, > 0: distances are needed this far from surfaces
  std::vector<Finding>* warnings = nullptr;
  std::vector<SceneFile>* used = nullptr;  ///< every file that is read is added here
  double depth = 3;                ///< distances are needed to so many times the reach inside of closed meshes
  std::uint64_t memory_limit = 0;  ///< bytes that a distance field may need; 0: what the machine has available
  FieldMemory* memory = nullptr;   ///< what each field takes is booked here
  bool kept = true;                ///< fields are part of the scene
  enum class Opening { warned_of, allowed, refused };
  Opening opening = Opening::warned_of;  ///< what becomes of a mesh that encloses no space
};

/// Reads the "shape" object at the path `where` of a scene (schema/scene.json, definition "shape"), for colliders and
/// anything else that occupies a part of space. The result is empty, with findings, where the shape is wrong; what the
/// schema has refused is skipped.
std::optional<Shape> read_shape(const Json& shape, const std::string& where, const ShapeFiles& files,
                                Findings& findings);

}  // namespace hooke::scene
