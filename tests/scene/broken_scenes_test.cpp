// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Every broken/NAME.json is refused with exactly the findings of broken/NAME.expected.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "hooke/scene/load_scene.h"
#include "hooke/scene/text_file.h"
#include "source_dir.h"
#include "support/openvdb.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;
const fs::path kFolder = HOOKE_SOURCE_DIR "/tests/scene/broken";

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    if (entry.path().extension() == ".json") all.push_back(entry.path().stem().string());
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::string read(const fs::path& file) {
  const auto text = scene::read_text_file(file, std::uint64_t{1} << 20U);
  return text ? *text : "";
}

class BrokenScene : public testing::TestWithParam<std::string> {};

TEST_P(BrokenScene, IsRefusedWithItsMessage) {
  // Without OpenVDB, errors of a distance field are not found.
  if (GetParam() == "bodies-meshes" || GetParam() == "emitters-meshes") HOOKE_NEEDS_OPENVDB();
  scene::LoadOptions options;
  options.memory_limit = std::uint64_t{1} << 30U;
  for (const bool in_slices : {false, true}) {
    options.in_slices = in_slices;
    const auto loaded =
        scene::parse_scene(read(kFolder / (GetParam() + ".json")), GetParam() + ".json", kFolder, options);
    ASSERT_FALSE(loaded) << "was taken for good";
    EXPECT_EQ(loaded.error().kind, Error::Kind::bad_input);
    EXPECT_EQ(loaded.error().text() + "\n", read(kFolder / (GetParam() + ".expected")));
  }
}

INSTANTIATE_TEST_SUITE_P(All, BrokenScene, testing::ValuesIn(names()), [](const auto& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace hooke
