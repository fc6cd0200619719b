// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/core/scene.h"
#include "hooke/scene/findings.h"
#include "hooke/scene/json_reader.h"
#include "hooke/scene/shape_reader.h"

namespace hooke {

/// Fills `scene.colliders` from the entries of "colliders"; the scene's materials are there already. What the schema's
/// findings touch is passed over. Writes the names of colliders that have none into `colliders`.
void build_colliders(Json& colliders, const ShapeFiles& files, Scene& scene, Findings& findings);

}  // namespace hooke
