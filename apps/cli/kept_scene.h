// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/scene/load_scene.h"

namespace hooke::cli {

/// The scene that a run's folder keeps, with what --set changes of it, without its particles. What ties them is that of
/// the run's checkpoint; before there is one, as the scene makes it, where its files can still be read.
Expected<LoadedScene> load_kept_scene(const std::filesystem::path& folder,
                                      const std::vector<std::string>& overrides = {});

}  // namespace hooke::cli
