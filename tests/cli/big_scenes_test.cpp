// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "bundled_scene.h"

namespace hooke::test {
namespace {

using BigScene = BundledScene;

TEST_P(BigScene, Runs) { hooke_ok({"run", file(), "-o", "out", "--steps", "10", "--quiet"}); }

INSTANTIATE_TEST_SUITE_P(Siblings, BigScene, testing::ValuesIn(bundled_names(true)), bundled_test_name);

}  // namespace
}  // namespace hooke::test
