// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "hooke/core/scene.h"
#include "hooke/scene/findings.h"
#include "hooke/scene/json_reader.h"
#include "hooke/scene/shape_reader.h"

namespace hooke {

/// Fills `scene.colliders` from the entries of "colliders"; the scene's materials are there already. What the schema's
/// findings touch is passed over. Writes the names of colliders that have none into `colliders`.
void build_colliders(Json& colliders, const ShapeFiles& files, Scene& scene, Findings& findings);

/// The "motion" of an entry at the path `where`; none where it has no such key, or the schema has found it wrong.
/// Nothing, with findings, where there is something wrong.
std::optional<Motion> read_motion(const Json& entry, const std::string& where, Findings& findings);

}  // namespace hooke
