// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Every scene of the gallery on several ranks, which are threads here: springs, cloths, bodies, births, sinks, lives,
// fields and attraction among them.

#include <gtest/gtest.h>

#include "gallery_scenes.h"
#include "support/engines.h"
#include "support/ranks.h"

namespace hooke::test {
namespace {

class GalleryOnRanks : public GalleryScenes {};

TEST_P(GalleryOnRanks, HasTheBitsOfOneRank) {
  const Engine engine{"cpu", loaded_.scene.precision, 1, ""};
  constexpr std::int64_t kSteps = 25;
  Simulation one = simulate(loaded_.scene, loaded_.particles, engine);
  ASSERT_TRUE(advance(one, kSteps));
  on_ranks(3, loaded_.scene, loaded_.particles, engine, [&](Simulation& many) {
    ASSERT_TRUE(advance(many, kSteps));
    EXPECT_EQ(many.state_hash(), one.state_hash());
    EXPECT_EQ(many.ledger(), one.ledger());
    EXPECT_EQ(many.particle_count(), one.particle_count());
  });
}

INSTANTIATE_TEST_SUITE_P(Gallery, GalleryOnRanks, testing::ValuesIn(bundled_names(false)), bundled_test_name);

}  // namespace
}  // namespace hooke::test
