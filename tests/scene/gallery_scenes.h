// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "hooke/scene/load_scene.h"
#include "support/bundled_scenes.h"
#include "support/openvdb.h"

namespace hooke::test {

/// Tests of a scene of the gallery each.
class GalleryScenes : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const std::filesystem::path file = bundled_folder() / (GetParam() + ".json");
    if (has_mesh(file)) HOOKE_NEEDS_OPENVDB();
    scene::LoadOptions options;
    options.overrides = bundled_overrides(GetParam());
    auto loaded = scene::load_scene(file, options);
    ASSERT_TRUE(loaded) << loaded.error().text();
    loaded_ = std::move(*loaded);
  }

  scene::LoadedScene loaded_;
};

}  // namespace hooke::test
