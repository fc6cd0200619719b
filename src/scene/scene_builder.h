// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "hooke/core/scene.h"
#include "hooke/scene/findings.h"
#include "hooke/scene/json_reader.h"
#include "hooke/scene/load_scene.h"

namespace hooke {

/// Fills `loaded.scene` with the rules of a scene from its JSON, defaults already in place, and says what is wrong with
/// them beyond the schema:
/// names that do not exist, values that contradict each other. What the schema's findings touch is passed over. Files
/// are looked for in `folder`. Writes mixed coefficients that contact entries leave out, and names of colliders, into
/// `json`.
void build_scene(Json& json, const std::filesystem::path& folder, const LoadOptions& options, Findings& findings,
                 LoadedScene& loaded);

/// A list of three numbers; `fallback` where the value is none.
Vec3d vec3_or(const Json& value, const Vec3d& fallback);

}  // namespace hooke
