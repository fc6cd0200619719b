// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/kept_scene.h"

#include <utility>

#include "hooke/io/checkpoint.h"
#include "hooke/io/run_folder.h"

namespace hooke::run {

Expected<scene::LoadedScene> load_kept_scene(const std::filesystem::path& folder,
                                             const std::vector<std::string>& overrides) {
  scene::LoadOptions options;
  options.overrides = overrides;
  options.allow_outside = true;  // the particle files at such paths are not read again
  options.with_particles = false;
  auto loaded = scene::load_scene(folder / io::kSceneFile, options);
  if (!loaded) return loaded;
  auto structure = io::read_structure_of_run(folder);
  if (!structure) return fail(std::move(structure).error());
  loaded->scene.structure = std::move(*structure);
  std::error_code ignored;
  if (std::filesystem::exists(folder / io::kCheckpointFile, ignored)) return loaded;
  options.with_particles = true;
  if (auto whole = scene::load_scene(folder / io::kSceneFile, options))
    loaded->scene.structure = std::move(whole->scene.structure);
  return loaded;
}

}  // namespace hooke::run
