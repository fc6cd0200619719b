// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "hooke/base/expected.h"

namespace hooke {

/// The file that a scene in `folder` means by `name`. Unless `allow_outside`, names that are absolute, hold "..", or
/// lead out of the folder through a symbolic link are errors; so is what is no file that can be read.
/// The error's only finding has an empty `where`.
Expected<std::filesystem::path> find_scene_file(const std::filesystem::path& folder, const std::string& name,
                                                bool allow_outside);

}  // namespace hooke
