// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/kept_scene.h"

#include <algorithm>
#include <utility>

#include "hooke/io/checkpoint.h"

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

Expected<void> check_materials(const io::RunReader& run, const Scene& scene) {
  const std::vector<io::MaterialInfo>& of_run = run.info().materials;
  const auto is_same = [](const Material& a, const io::MaterialInfo& b) { return a.name == b.name; };
  if (std::equal(scene.materials.begin(), scene.materials.end(), of_run.begin(), of_run.end(), is_same)) return {};
  return fail(Error::Kind::bad_input, run.file().string(), "has particles of other materials than its scene");
}

}  // namespace hooke::run
