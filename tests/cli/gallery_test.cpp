// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "bundled_scene.h"

namespace hooke::test {
namespace {

TEST_P(BundledScene, EndsOnTheSameBitsAfterARestart) {
  const bool half_a_million = GetParam() == "water" || GetParam() == "table-6.1";
  const int steps = half_a_million ? 6 : GetParam() == "galaxy" ? 40 : 120;  // of a galaxy each is a sum over all pairs
  const std::string all = std::to_string(2 * steps), half = std::to_string(steps);
  hooke_ok({"run", file(), "-o", "whole", "--steps", all, "--threads", "2", "--quiet"});
  hooke_ok({"run", file(), "-o", "parts", "--steps", half, "--threads", "1", "--quiet"});
  hooke_ok({"run", file(), "-o", "parts", "--steps", all, "--quiet", "--resume", "parts/checkpoint.h5"});
  EXPECT_EQ(state_hash("parts"), state_hash("whole"));
}

INSTANTIATE_TEST_SUITE_P(Gallery, BundledScene, testing::ValuesIn(bundled_names(false)), bundled_test_name);

TEST(Gallery, HasABigSiblingOfEveryScene) {
  const std::vector<std::string> big = bundled_names(true);
  for (const std::string& name : bundled_names(false)) {
    if (name == "table-6.1") continue;  // its numbers are the thesis's
    EXPECT_TRUE(std::binary_search(big.begin(), big.end(), name + "-big")) << name;
  }
}

}  // namespace
}  // namespace hooke::test
