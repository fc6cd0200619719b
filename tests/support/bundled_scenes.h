// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <vector>

#include "source_dir.h"

namespace hooke::test {

/// The folder of the scenes that come with Hooke, for tests that are told where the sources are.
inline std::filesystem::path bundled_folder() { return HOOKE_SOURCE_DIR "/scenes"; }

/// The scenes' names, ascending: only the big siblings, or all others.
inline std::vector<std::string> bundled_names(bool big) {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(bundled_folder())) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".json" && name.ends_with("-big") == big) found.push_back(name);
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Overrides that leave a scene's particles unchanged and save a test seconds: the hourglass's glass takes seconds.
inline std::vector<std::string> bundled_overrides(const std::string& name) {
  if (name == "hourglass") return {"colliders[0].shape.mesh.voxel=0.012"};
  return {};
}

/// The name of a test of a bundled scene.
inline std::string bundled_test_name(const testing::TestParamInfo<std::string>& test) {
  std::string name = test.param;
  std::replace_if(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

}  // namespace hooke::test
