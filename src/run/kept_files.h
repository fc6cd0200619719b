// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/scene/load_scene.h"

namespace hooke::run {

/// Copies of the meshes that a scene names, in the run folder beside its scene, so that the folder can be drawn
/// anywhere. Meshes named by an absolute path or with ".." are not copied. The copies have other names until keep(), so
/// that a copy that fails leaves an older run in the folder as it is.
class KeptFiles {
 public:
  /// io where a mesh can't be read or its copy not be written; then nothing is left behind.
  static Expected<KeptFiles> copy(const std::vector<scene::SceneFile>& files, const std::filesystem::path& folder);

  /// Removes the copies, unless they are kept, and the folders made for them.
  ~KeptFiles();
  KeptFiles(KeptFiles&&) = default;
  KeptFiles& operator=(KeptFiles&&) = default;

  /// Gives the copies their names, in place of older files.
  Expected<void> keep();

 private:
  KeptFiles() = default;
  Expected<void> copy_one(const std::filesystem::path& from, const std::filesystem::path& kept);

  // The copies, each with the name that it will have.
  std::vector<std::pair<std::filesystem::path, std::filesystem::path>> copies_;
  // Made here, the innermost first.
  std::vector<std::filesystem::path> folders_;
};

}  // namespace hooke::run
