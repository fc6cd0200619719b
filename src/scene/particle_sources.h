// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/scene/findings.h"
#include "hooke/scene/json_reader.h"
#include "hooke/scene/load_scene.h"

namespace hooke::scene {

/// Makes the particles of a scene's sources, sorted by id; or `slices`, as options.in_slices says. Checks all sources
/// and compares the memory they will need with the memory available before it makes any particles. Leaves out sources
/// that earlier findings touch. Without options.with_particles it checks the text of the sources and makes nothing.
ParticleSet load_particles(const Json& json, const Scene& scene, const std::filesystem::path& folder,
                           const LoadOptions& options, Findings& findings, std::vector<Finding>& warnings,
                           std::shared_ptr<const ParticleSlices>& slices);

}  // namespace hooke::scene
