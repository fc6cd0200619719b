// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/scene_path.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "scratch_folder.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

class ScenePathTest : public testing::Test {
 protected:
  ScenePathTest() {
    fs::create_directories(home_ / "data");
    scratch_.write("outside.csv", "x,y,z\n");
    scratch_.write("scene/inside.csv", "x,y,z\n");
    fs::create_symlink(scratch_.path() / "outside.csv", home_ / "link.csv");
    fs::create_directory_symlink(scratch_.path(), home_ / "up");
    fs::create_symlink(home_ / "inside.csv", home_ / "data" / "alias.csv");
  }
  std::string refusal(const std::string& name, bool allow_outside = false) {
    const auto found = scene::find_scene_file(home_, name, allow_outside);
    return found ? "" : found.error().findings.front().message;
  }

  ScratchFolder scratch_;
  fs::path home_ = scratch_.path() / "scene";
};

TEST_F(ScenePathTest, FindsWhatLiesInTheFolder) {
  EXPECT_EQ(refusal("inside.csv"), "");
  EXPECT_EQ(refusal("./inside.csv"), "");
  EXPECT_EQ(refusal("data/alias.csv"), "");
}

TEST_F(ScenePathTest, KeepsToTheFolder) {
  EXPECT_NE(refusal("../outside.csv").find(".."), std::string::npos);
  EXPECT_NE(refusal("data/../inside.csv").find(".."), std::string::npos);
  EXPECT_NE(refusal((scratch_.path() / "outside.csv").string()).find("absolute"), std::string::npos);
  EXPECT_NE(refusal("link.csv").find("symbolic link"), std::string::npos);
  EXPECT_NE(refusal("up/outside.csv").find("symbolic link"), std::string::npos);
}

TEST_F(ScenePathTest, LeavesItWhereThatIsAllowed) {
  EXPECT_EQ(refusal("../outside.csv", true), "");
  EXPECT_EQ(refusal((scratch_.path() / "outside.csv").string(), true), "");
  EXPECT_EQ(refusal("link.csv", true), "");
}

TEST_F(ScenePathTest, RefusesWhatIsNoFile) {
  ASSERT_EQ(::mkfifo((home_ / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(refusal("none.csv"), "can't be opened: No such file or directory");
  EXPECT_EQ(refusal("data"), "is no regular file");
  EXPECT_EQ(refusal("pipe"), "is no regular file");
  EXPECT_EQ(refusal(std::string("inside.csv\0x", 12)), "holds a null character");
}

}  // namespace
}  // namespace hooke
