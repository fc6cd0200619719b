// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "hooke/core/scene.h"
#include "hooke/scene/findings.h"
#include "hooke/scene/json_reader.h"
#include "hooke/scene/shape_reader.h"

namespace hooke::scene {

/// Fills `scene.colliders` from the entries of "colliders"; the scene already has its materials. Skips what the
/// schema's findings touch. Writes generated names for unnamed colliders into `colliders`.
void build_colliders(Json& colliders, const ShapeFiles& files, Scene& scene, Findings& findings);

/// Reads the "motion" of the entry at the path `where`: no motion where the entry has no such key or the schema has
/// refused it. The result is empty, with findings, where the motion is wrong.
std::optional<Motion> read_motion(const Json& entry, const std::string& where, Findings& findings);

}  // namespace hooke::scene
