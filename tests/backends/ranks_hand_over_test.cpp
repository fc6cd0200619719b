// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Particles that several ranks hand over a slice at a time.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "busy_scenes.h"
#include "support/ranks.h"

namespace hooke::test {
namespace {

// The slices one after the other; each but the last is of `rows` particles.
ParticleSet joined(const ParticleSlices& slices, std::size_t rows) {
  ParticleSet all;
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  EXPECT_TRUE(slices.visit(rows, [&](const ParticleSlice& p) {
    EXPECT_EQ(all.size() % rows, 0U) << "only the last may be shorter";
    EXPECT_TRUE(p.size() > 0 && p.size() <= rows) << p.size();
    append(all.id, p.id);
    append(all.material, p.material);
    append(all.position, p.position);
    append(all.velocity, p.velocity);
    append(all.acceleration, p.acceleration);
  }));
  return all;
}

void expect_equal(const ParticleSet& a, const ParticleSet& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.material, b.material);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.acceleration, b.acceleration);
}

class BusyScenesInSlices : public BusyScenes {};

TEST_P(BusyScenesInSlices, AreTheParticles) {
  Simulation one = simulate(scene_, particles_, engine(1));
  ASSERT_TRUE(advance(one, 60));
  const ParticleSet& all = one.particles();
  for (const int ranks : {1, 2, 3, 5}) {
    SCOPED_TRACE(ranks);
    on_ranks(ranks, scene_, particles_, engine(1), [&](Simulation& many) {
      ASSERT_TRUE(advance(many, 60));
      const std::unique_ptr<const ParticleSlices> slices = many.slices();
      EXPECT_EQ(slices->size(), all.size());
      EXPECT_EQ(slices->identity(), SlicesOfSet(all).identity());
      EXPECT_EQ(slices->has_accelerations(), !all.acceleration.empty());
      const std::size_t n = std::max<std::size_t>(all.size(), 1);
      for (const std::size_t rows : {n / 7 + 1, n, n + 5}) expect_equal(joined(*slices, rows), all);
      ASSERT_TRUE(advance(many, 5));
      expect_equal(joined(*many.slices(), n), many.particles());
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, BusyScenesInSlices, all_busy_kinds(),
                         [](const auto& instance) { return instance.param.name(); });

// Ids that are far apart, and none at all.
TEST(Slices, AreHandedOverWithAnyIds) {
  const Scene scene = open_scene();
  ParticleSet particles = lattice(scene, {5, 4, 3}, {-2, -2, -2}, 1.2, 0.01, 1);
  for (std::size_t i = 0; i < particles.size(); ++i)
    particles.id[i] = i < 30 ? 3 * i + 1 : (std::uint64_t{1} << 40U) * i;
  on_ranks(3, scene, particles, kCpuDouble, [&](Simulation& many) {
    for (const std::size_t rows : {1U, 7U, 60U}) expect_equal(joined(*many.slices(), rows), particles);
  });
  on_ranks(3, scene, {}, kCpuDouble, [&](Simulation& many) { EXPECT_TRUE(joined(*many.slices(), 10).empty()); });
}

}  // namespace
}  // namespace hooke::test
