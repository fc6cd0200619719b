// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "bundled_scene.h"

namespace hooke::test {
namespace {

TEST_P(BundledScene, EndsOnTheSameBitsAfterARestart) {
  const bool half_a_million = GetParam() == "water" || GetParam() == "table-6.1";
  const int steps = half_a_million ? 6 : GetParam() == "galaxy" ? 20 : 80;  // the galaxy sums over all pairs
  const auto run = [&](const std::string& folder, int last, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"run", file(), "-o", folder, "--steps", std::to_string(last), "--quiet"});
    for (const std::string& value : bundled_overrides(GetParam())) {
      arguments.insert(arguments.end(), {"--set", value});
    }
    hooke_ok(arguments);
  };
  run("whole", 2 * steps, {"--threads", "2"});
  run("parts", steps, {"--threads", "1"});
  run("parts", 2 * steps, {"--resume", "parts/checkpoint.h5"});
  EXPECT_EQ(state_hash("parts"), state_hash("whole"));
}

INSTANTIATE_TEST_SUITE_P(Gallery, BundledScene, testing::ValuesIn(bundled_names(false)), bundled_test_name);

TEST(Gallery, HasABigSiblingOfEveryScene) {
  const std::vector<std::string> big = bundled_names(true);
  for (const std::string& name : bundled_names(false)) {
    if (name == "table-6.1") continue;  // its numbers are from the thesis
    EXPECT_TRUE(std::binary_search(big.begin(), big.end(), name + "-big")) << name;
  }
}

}  // namespace
}  // namespace hooke::test
