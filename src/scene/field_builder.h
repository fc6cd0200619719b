// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/core/scene.h"
#include "hooke/scene/findings.h"
#include "hooke/scene/json_reader.h"

namespace hooke::scene {

/// Builds a scene's "fields" from their JSON, which has its defaults; the scene already has its materials. Faults
/// beyond the schema go to `findings`.
void build_fields(Json& fields, Scene& scene, Findings& findings);

}  // namespace hooke::scene
