// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/body_overlaps.h"

#include <gtest/gtest.h>

#include "hooke/core/free_space.h"
#include "hooke/core/placed_colliders.h"
#include "support/capsule_field.h"
#include "support/small_slices.h"

namespace hooke::test {
namespace {

constexpr double kRadius = 0.1;

Scene box_scene() {
  Scene scene;
  scene.domain = {{-3, -3, -3}, {3, 3, 3}, {Boundary::spring, Boundary::spring, Boundary::open}};
  scene.materials = {{"grain", kRadius, 1, {100, 0, 0}, 0, ""}};
  return scene;
}

Collider collider(const Shape& shape, bool hollow = false) {
  Collider made;
  made.name = "body";
  made.shape = shape;
  made.hollow = hollow;
  return made;
}

ParticleSet particles_at(const std::vector<Vec3d>& places) {
  ParticleSet set;
  for (const Vec3d& x : places) {
    set.id.push_back(set.id.size() + 10);
    set.material.push_back(0);
    set.position.push_back(x);
    set.velocity.push_back({0, 0, 0});
  }
  return set;
}

/// Every shape that is solid around the origin, of a half width of 1 at least.
std::vector<std::pair<const char*, Shape>> solids() {
  return {{"box", BoxShape{{-1, -1, -1}, {1, 1, 1}}},
          {"sphere", SphereShape{{0, 0, 0}, 1}},
          {"capsule", CapsuleShape{{0, -1, 0}, {0, 1, 0}, 1}},
          {"cylinder", CylinderShape{{0, -1, 0}, {0, 1, 0}, 1}},
          {"mesh", capsule_with_field({0, 0, 0}, 1, true, kRadius)}};
}

TEST(BodyOverlaps, CountsWhoOverlapsWalls) {
  const Scene scene = box_scene();
  const auto found =
      find_body_overlaps(scene, particles_at({{-2.95, 0, 0}, {-2.98, 2.91, 0}, {0, 0, 2.99}, {0, 0, 0}}));
  ASSERT_EQ(found.size(), 2U) << "an open face is no wall";
  EXPECT_EQ(found[0].face, Face::x_min);
  EXPECT_EQ(found[0].touching, 2U);
  EXPECT_EQ(found[0].deepest, 11U);
  EXPECT_NEAR(found[0].ratio, 0.8, 1e-12);
  EXPECT_EQ(found[1].face, Face::y_max);
  EXPECT_EQ(found[1].touching, 1U);
  EXPECT_NEAR(found[1].ratio, 0.1, 1e-12);
  EXPECT_EQ(found[1].inside, 0U);
  EXPECT_TRUE(find_body_overlaps(scene, {}).empty());
}

TEST(BodyOverlaps, CountsWhoIsInsideASolidOfAnyShape) {
  for (const auto& [name, shape] : solids()) {
    Scene scene = box_scene();
    scene.colliders = {collider(SphereShape{{0, 2.5, 2.5}, 0.1}), collider(shape)};
    const auto found = find_body_overlaps(scene, particles_at({{0, 0, 0}, {0.95, 0, 0}, {1.05, 0, 0}, {1.5, 0, 0}}));
    ASSERT_EQ(found.size(), 1U) << name;
    EXPECT_EQ(found[0].face, Face::none) << name;
    EXPECT_EQ(found[0].collider, 1U) << name;
    EXPECT_EQ(found[0].inside, 2U) << name;
    EXPECT_GE(found[0].touching, 2U) << name;
    scene.colliders[1].hollow = true;
    const auto shell = find_body_overlaps(scene, particles_at({{0, 0, 0}, {0.95, 0, 0}, {1.05, 0, 0}}));
    ASSERT_EQ(shell.size(), 1U) << name;
    EXPECT_EQ(shell[0].inside, 0U) << name;
    EXPECT_EQ(shell[0].touching, 2U) << name << ": each once, however many of its faces they overlap";
    EXPECT_NEAR(shell[0].ratio, 0.5, 0.02) << name;
  }
}

TEST(BodyOverlaps, FindsTheDeepestOfManyInAnyOrder) {
  Scene scene = box_scene();
  scene.colliders = {collider(SphereShape{{0, 0, 0}, 0.3})};
  std::vector<Vec3d> places;
  for (int i = 0; i < 20000; ++i) places.push_back({2 - 1e-4 * i, 0, 0});
  const auto found = find_body_overlaps(scene, particles_at(places));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].deepest, 20009U);
  EXPECT_NEAR(found[0].ratio, (0.4 - 1e-4) / kRadius, 1e-9);
  EXPECT_NEAR(static_cast<double>(found[0].touching), 4000, 1);

  const ParticleSet particles = particles_at(places);
  const auto sliced = find_body_overlaps_in_slices(scene, SmallSlices(particles, 777));
  ASSERT_TRUE(sliced && sliced->size() == 1);
  EXPECT_EQ(sliced->front().deepest, found[0].deepest);
  EXPECT_EQ(sliced->front().ratio, found[0].ratio);
  EXPECT_EQ(sliced->front().touching, found[0].touching);
  EXPECT_EQ(sliced->front().inside, found[0].inside);
  EXPECT_FALSE(find_body_overlaps_in_slices(scene, SmallSlices(particles, 777, 1)));
}

TEST(FreeSpace, HasNoRoomInsideASolidOfAnyShape) {
  for (const auto& [name, shape] : solids()) {
    Scene scene = box_scene();
    scene.colliders = {collider(shape)};
    const std::vector<ColliderPose> poses{pose_at(scene.colliders[0], 0)};
    const auto solid = place_colliders<double>(scene, poses, kRadius);
    const FreeSpace outside(scene, 0, solid.all);
    for (const double x : {0.0, 0.3, 0.6, 0.9, 1.05}) EXPECT_FALSE(outside.has_room_at({x, 0, 0})) << name << x;
    EXPECT_TRUE(outside.has_room_at({1.2, 0, 0})) << name;
    scene.colliders[0].hollow = true;
    const auto shell = place_colliders<double>(scene, poses, kRadius);
    const FreeSpace inside(scene, 0, shell.all);
    EXPECT_TRUE(inside.has_room_at({0, 0, 0})) << name;
    EXPECT_FALSE(inside.has_room_at({0.95, 0, 0})) << name;
  }
}

}  // namespace
}  // namespace hooke::test
