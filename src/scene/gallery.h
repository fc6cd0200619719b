// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hooke/base/expected.h"

namespace hooke::scene {

/// One scene of a gallery, as it describes itself.
struct GalleryScene {
  std::filesystem::path file;
  std::string title;        ///< its "name", or the file's name where it has none
  std::string description;  ///< its "description", may be empty
};

/// The scenes in a folder: its .json files that have the key "hooke", sorted by file name. An error where the folder
/// can't be read.
Expected<std::vector<GalleryScene>> list_scenes(const std::filesystem::path& folder);

}  // namespace hooke::scene
