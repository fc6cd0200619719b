// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/core/scene.h"
#include "hooke/scene/findings.h"
#include "hooke/scene/json_reader.h"
#include "hooke/scene/shape_reader.h"

namespace hooke::scene {

/// Fills `scene.emitters` from the entries of "emitters"; the scene already has its materials. Skips what the schema's
/// findings touch. Writes generated names for unnamed emitters into `emitters`. Returns the index of the JSON entry of
/// each emitter in the scene.
std::vector<std::size_t> build_emitters(Json& emitters, const ShapeFiles& files, Scene& scene, Findings& findings);

/// Fills `scene.sinks` from the entries of "sinks" in the same way; sinks have no names.
std::vector<std::size_t> build_sinks(const Json& sinks, const ShapeFiles& files, Scene& scene, Findings& findings);

}  // namespace hooke::scene
