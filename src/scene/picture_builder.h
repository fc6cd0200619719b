// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/core/scene.h"
#include "hooke/scene/findings.h"
#include "hooke/scene/json_reader.h"

namespace hooke::scene {

/// Reads `camera`; the scene's materials and colliders are known. What the schema refused keeps its default.
void build_camera(const Json& camera, Scene& scene, Findings& findings);
/// Reads `picture`.
void build_picture(const Json& picture, Scene& scene, const Findings& findings);

}  // namespace hooke::scene
