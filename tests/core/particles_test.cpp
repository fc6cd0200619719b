// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/particles.h"

#include <gtest/gtest.h>

namespace hooke {
namespace {

ParticleSet three() {
  ParticleSet p;
  p.id = {9, 2, 5};
  p.material = {1, 2, 3};
  p.position = {{9, 0, 0}, {2, 0, 0}, {5, 0, 0}};
  p.velocity = {{0, 9, 0}, {0, 2, 0}, {0, 5, 0}};
  p.acceleration = {{0, 0, 9}, {0, 0, 2}, {0, 0, 5}};
  return p;
}

TEST(ParticleSet, SortsAllColumnsById) {
  ParticleSet p = three();
  p.sort_by_id();
  EXPECT_EQ(p.id, (std::vector<std::uint64_t>{2, 5, 9}));
  EXPECT_EQ(p.material, (std::vector<std::uint16_t>{2, 3, 1}));
  for (std::size_t i = 0; i < 3; ++i) {
    const auto id = static_cast<double>(p.id[i]);
    EXPECT_EQ(p.position[i], (Vec3d{id, 0, 0}));
    EXPECT_EQ(p.velocity[i], (Vec3d{0, id, 0}));
    EXPECT_EQ(p.acceleration[i], (Vec3d{0, 0, id}));
  }
}

TEST(ParticleSet, SortsWithoutAccelerations) {
  ParticleSet p = three();
  p.acceleration.clear();
  p.sort_by_id();
  EXPECT_EQ(p.id.front(), 2U);
  EXPECT_TRUE(p.acceleration.empty());
}

TEST(ParticleSet, FindsById) {
  ParticleSet p = three();
  p.sort_by_id();
  EXPECT_EQ(p.find(2), 0U);
  EXPECT_EQ(p.find(9), 2U);
  for (const std::uint64_t unknown : {0U, 3U, 10U}) EXPECT_EQ(p.find(unknown), p.size());
  EXPECT_EQ(ParticleSet{}.find(1), 0U);
}

TEST(ParticleSet, ResizesTheAccelerationsThatItHas) {
  ParticleSet p = three();
  p.resize(2);
  EXPECT_EQ(p.acceleration.size(), 2U);
  p.acceleration.clear();
  p.resize(5);
  EXPECT_EQ(p.size(), 5U);
  EXPECT_TRUE(p.acceleration.empty());
  p.clear();
  EXPECT_TRUE(p.empty());
}

}  // namespace
}  // namespace hooke
