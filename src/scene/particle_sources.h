// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/scene/findings.h"
#include "hooke/scene/json_reader.h"
#include "hooke/scene/load_scene.h"

namespace hooke {

/// The particles that a scene's sources hold, by id. First all sources are looked at and what they will need is held
/// against the memory there is; only then anything is made. Sources that earlier findings touch are left out.
/// Without options.with_particles sources are checked as they are written, and nothing is made.
ParticleSet load_particles(const Json& json, const Scene& scene, const std::filesystem::path& folder,
                           const LoadOptions& options, Findings& findings, std::vector<Finding>& warnings);

}  // namespace hooke
