// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "hooke/base/expected.h"

namespace hooke::scene {

/// The file that a scene in `folder` means by `name`. Unless `allow_outside`, a name is an error if it is absolute,
/// holds "..", or leads out of the folder through a symbolic link; so is a name without a readable file. The error's
/// only finding has an empty `where`.
Expected<std::filesystem::path> find_scene_file(const std::filesystem::path& folder, const std::string& name,
                                                bool allow_outside);

}  // namespace hooke::scene
