// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Sums over particles, block by block, against sums over all particles, voxel by voxel.
#include "hooke/volumes/field_blocks.h"

#include <gtest/gtest.h>

#include <numeric>

#include "support/particles.h"

namespace hooke {
namespace {

constexpr double kVoxel = 0.1;

TEST(FieldBlocks, SumWhatReachesEachVoxel) {
  std::vector<Vec3d> position;
  std::vector<double> reach;
  std::vector<std::array<float, 1>> value;
  for (std::uint64_t i = 0; i < 50; ++i) {
    const auto r = test::random4(5, i);
    position.push_back({3 * r[0] - 1.5, 3 * r[1] - 1.5, 3 * r[2] - 1.5});
    reach.push_back(i % 7 == 0 ? 1.1 : 0.3);  // the larger reach spans a whole block
    value.push_back({static_cast<float>(r[3])});
  }
  const volumes::FieldBlocks blocks(position, reach, kVoxel);
  std::vector<std::size_t> all(blocks.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<volumes::FieldBlocks::Sums<1>> sums(blocks.size());
  blocks.sum<1>(all, value, [&](std::size_t b, const volumes::FieldBlocks::Sums<1>& found) { sums[b] = found; });

  std::size_t reached = 0;
  for (int i = -30; i <= 30; ++i) {
    for (int j = -30; j <= 30; ++j) {
      for (int k = -30; k <= 30; ++k) {
        const Vec3d x = kVoxel * Vec3d{double(i), double(j), double(k)};
        double weight = 0, weighted = 0;
        for (std::size_t p = 0; p < position.size(); ++p) {
          const Vec3d d = x - position[p];
          const double rest = 1 - dot(d, d) / (reach[p] * reach[p]);
          if (rest <= 0) continue;
          weight += rest * rest * rest;
          weighted += rest * rest * rest * static_cast<double>(value[p][0]);
        }
        const auto block = blocks.find(*volumes::FieldBlocks::block_at(x + Vec3d{0.01, 0.01, 0.01}, kVoxel));
        if (!block) {
          ASSERT_EQ(weight, 0) << i << ' ' << j << ' ' << k;
          continue;
        }
        const auto voxel = static_cast<std::size_t>(((i & 7) * 8 + (j & 7)) * 8 + (k & 7));
        ASSERT_NEAR(sums[*block].weight[voxel], weight, 1e-5) << i << ' ' << j << ' ' << k;
        ASSERT_NEAR(sums[*block].value[0][voxel], weighted, 1e-5) << i << ' ' << j << ' ' << k;
        reached += weight > 0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(reached, 10000U);
}

TEST(FieldBlocks, KnowHowFarTheyGo) {
  const double edge = volumes::FieldBlocks::kEdge * kVoxel;
  EXPECT_EQ(volumes::FieldBlocks::block_at({-0.01, 0, 0.99 * edge}, kVoxel),
            (volumes::FieldBlocks::Coordinates{-1, 0, 0}));
  EXPECT_TRUE(volumes::FieldBlocks::block_at({edge * volumes::FieldBlocks::kMaxBlock, 0, 0}, kVoxel));
  EXPECT_FALSE(volumes::FieldBlocks::block_at({edge * (volumes::FieldBlocks::kMaxBlock + 2), 0, 0}, kVoxel));
  EXPECT_FALSE(volumes::FieldBlocks::block_at({0, std::nan(""), 0}, kVoxel));
}

}  // namespace
}  // namespace hooke
