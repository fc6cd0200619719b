// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/gallery.h"

#include <gtest/gtest.h>

#include "scratch_folder.h"
#include "source_dir.h"

namespace hooke {
namespace {

TEST(Gallery, ListsScenesByNameOfFile) {
  const ScratchFolder folder;
  folder.write("b.json", R"({"hooke": 1, "name": "Bee", "description": "buzzes"})");
  folder.write("a.json", R"({"hooke": 1}  // nothing said)");
  folder.write("other.json", R"({"version": 3})");
  folder.write("broken.json", "{");
  folder.write("notes.txt", R"({"hooke": 1})");
  const auto scenes = scene::list_scenes(folder.path());
  ASSERT_TRUE(scenes);
  ASSERT_EQ(scenes->size(), 2U);
  EXPECT_EQ((*scenes)[0].title, "a");
  EXPECT_EQ((*scenes)[0].description, "");
  EXPECT_EQ((*scenes)[1].title, "Bee");
  EXPECT_EQ((*scenes)[1].description, "buzzes");
  EXPECT_EQ((*scenes)[1].file, folder.path() / "b.json");
}

TEST(Gallery, EveryBundledSceneSaysWhatThereIsToSee) {
  const auto scenes = scene::list_scenes(HOOKE_SOURCE_DIR "/scenes");
  ASSERT_TRUE(scenes);
  EXPECT_GE(scenes->size(), 4U);
  for (const scene::GalleryScene& scene : *scenes) EXPECT_FALSE(scene.description.empty()) << scene.file;
}

TEST(Gallery, NamesAFolderThatIsNotThere) {
  const auto scenes = scene::list_scenes("/nowhere/at/all");
  ASSERT_FALSE(scenes);
  EXPECT_EQ(scenes.error().findings.front().where, "/nowhere/at/all");
}

}  // namespace
}  // namespace hooke
