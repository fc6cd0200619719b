// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/scene.h"
#include "hooke/io/run_folder.h"
#include "hooke/scene/load_scene.h"

namespace hooke::run {

/// The scene kept in a run's folder, with the changes of --set, without its particles. Its structure is that of the
/// run's checkpoint; before the first checkpoint it is made from the scene, if the scene's files can still be read.
Expected<scene::LoadedScene> load_kept_scene(const std::filesystem::path& folder,
                                             const std::vector<std::string>& overrides = {});

/// bad_input where the particles of `run` are of other materials than those of `scene`.
Expected<void> check_materials(const io::RunReader& run, const Scene& scene);

}  // namespace hooke::run
