// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "hooke/core/scene.h"
#include "hooke/scene/findings.h"
#include "hooke/scene/json_reader.h"
#include "hooke/scene/load_scene.h"

namespace hooke::scene {

/// Fills `loaded.scene` from a scene's JSON, defaults already in place, and reports faults beyond the schema: names
/// that do not exist, values that contradict each other. Skips what the schema's findings touch. Looks for files in
/// `folder`. Writes the mixed coefficients that contact entries leave out, and names of colliders, into `json`.
void build_scene(Json& json, const std::filesystem::path& folder, const LoadOptions& options, Findings& findings,
                 LoadedScene& loaded);

/// A list of three numbers as a vector; `fallback` where the value is not such a list.
Vec3d vec3_or(const Json& value, const Vec3d& fallback);

}  // namespace hooke::scene
