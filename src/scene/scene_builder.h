// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/core/scene.h"
#include "hooke/scene/findings.h"
#include "hooke/scene/json_reader.h"

namespace hooke {

/// The rules of a scene from its JSON, defaults already in place, and what is wrong with them beyond the schema:
/// names that do not exist, values that contradict each other. What the schema's findings touch is passed over. Writes
/// mixed coefficients that contact entries leave out into `json`.
Scene build_scene(Json& json, Findings& findings);

/// A list of three numbers; `fallback` where the value is none.
Vec3d vec3_or(const Json& value, const Vec3d& fallback);

}  // namespace hooke
