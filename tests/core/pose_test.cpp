// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hooke/core/scene.h"

namespace hooke {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

void expect_near(const Vec3d& a, const Vec3d& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

Collider ball(Motion motion) {
  Collider c;
  c.name = "ball";
  c.shape = SphereShape{{1, 2, 3}, 0.5};
  c.motion = std::move(motion);
  return c;
}

// Velocity of a point of the collider, from the pose's velocities.
Vec3d velocity_of(const Collider& c, double time, const Vec3d& x) {
  const ColliderPose pose = pose_at(c, time);
  return pose.velocity + cross(pose.angular_velocity, moved_point(c, pose, x) - pose.pivot);
}

// The pose's velocities are the rates at which it moves points: compared with central differences, which have an error
// of order h^2 = 1e-8.
void expect_consistent(const Collider& c, double time) {
  constexpr double kStep = 1e-4;
  for (const Vec3d x : {Vec3d{1, 2, 3}, Vec3d{2, 0, 3}, Vec3d{0, 0, 7}}) {
    const Vec3d later = moved_point(c, pose_at(c, time + kStep), x);
    const Vec3d before = moved_point(c, pose_at(c, time - kStep), x);
    expect_near(velocity_of(c, time, x), (0.5 / kStep) * (later - before), 1e-5);
  }
}

TEST(Pose, OfAShapeAtRestLeavesItWhereItIs) {
  const Collider c = ball(NoMotion{});
  for (const Vec3d x : {Vec3d{1, 2, 3}, Vec3d{-4, 0.1, 7}}) expect_near(moved_point(c, pose_at(c, 5), x), x, 1e-15);
  EXPECT_EQ(velocity_of(c, 5, {4, 4, 4}), (Vec3d{0, 0, 0}));
}

TEST(Pose, OfSteadyMotionTurnsAboutItsPivot) {
  const Collider c = ball(SteadyMotion{{1, 0, 0}, {0, 0, kTurn / 4}, Vec3d{0, 0, 0}});
  // A quarter of a turn a second about z, while the pivot moves along x.
  expect_near(moved_point(c, pose_at(c, 1), {1, 0, 0}), {1, 1, 0}, 1e-14);
  expect_near(moved_point(c, pose_at(c, 2), {1, 0, 0}), {1, 0, 0}, 1e-14);
  expect_near(moved_point(c, pose_at(c, 400), {1, 0, 5}), {401, 0, 5}, 1e-10);
  for (const double time : {0.0, 0.3, 1.7, 60.0}) expect_consistent(c, time);
}

TEST(Pose, TurnsAboutTheMiddleOfTheShapeByDefault) {
  const Collider c = ball(SteadyMotion{{0, 0, 0}, {0, 3, 0}, {}});
  expect_near(moved_point(c, pose_at(c, 7), {1, 2, 3}), {1, 2, 3}, 1e-14);
}

TEST(Pose, OfKeyframesGoesEvenlyFromEachToTheNext) {
  KeyframeMotion motion;
  motion.keyframes = {{1, {0, 0, 0}, {0, 0, 0}}, {2, {0, 2, 0}, {0, kTurn, 0}}, {4, {2, 2, 0}, {1, kTurn, -2}}};
  const Collider c = ball(motion);
  expect_near(moved_point(c, pose_at(c, 0), {1, 2, 3}), {1, 2, 3}, 1e-15);
  expect_near(moved_point(c, pose_at(c, 1.25), {2, 2, 3}), {1, 2.5, 2}, 1e-14);  // +x turns to -z about y
  expect_near(moved_point(c, pose_at(c, 2), {2, 2, 3}), {2, 4, 3}, 1e-14);
  expect_near(moved_point(c, pose_at(c, 3), {1, 2, 3}), {2, 4, 3}, 1e-14);
  expect_near(moved_point(c, pose_at(c, 9), {1, 2, 3}), {3, 4, 3}, 1e-14);
  for (const double time : {0.5, 1.1, 1.9, 2.3, 3.7, 5.0}) expect_consistent(c, time);
  EXPECT_EQ(pose_at(c, 9).velocity, (Vec3d{0, 0, 0})) << "after the last it rests";
  EXPECT_EQ(pose_at(c, 9).angular_velocity, (Vec3d{0, 0, 0}));
}

TEST(Pose, OfAnOscillationIsASine) {
  const Collider c = ball(Oscillation{{0, 2, 0}, 0.5, 0.25});
  expect_near(moved_point(c, pose_at(c, 0), {0, 0, 0}), {0, 2, 0}, 1e-15);
  expect_near(moved_point(c, pose_at(c, 0.5), {0, 0, 0}), {0, 0, 0}, 1e-15);
  expect_near(moved_point(c, pose_at(c, 1), {0, 0, 0}), {0, -2, 0}, 1e-15);
  for (const double time : {0.0, 0.4, 13.3}) expect_consistent(c, time);
}

TEST(TurnedAxes, AreThoseOfALongRotationAndOfATinyOne) {
  // The series for small angles joins the formula at 0.01 rad.
  for (const double angle : {1e-9, 0.009999, 0.010001, 1.0, 3.0, 40.0}) {
    const auto axes = turned_axes({0, 0, angle});
    const double rounding = 1e-15 + 1e-16 * angle;
    expect_near(axes[0], {std::cos(angle), std::sin(angle), 0}, rounding);
    expect_near(axes[1], {-std::sin(angle), std::cos(angle), 0}, rounding);
    expect_near(axes[2], {0, 0, 1}, 0);
  }
}

TEST(CheckColliders, NamesWhatIsWrong) {
  Scene scene;
  scene.materials.resize(1);
  scene.materials[0].name = "water";
  const auto text = [&](Collider c) {
    scene.colliders = {std::move(c)};
    const std::vector<Finding> findings = validate(scene);
    return findings.empty() ? "" : findings[0].where + ": " + findings[0].message;
  };
  EXPECT_EQ(text(ball(NoMotion{})), "");
  Collider c = ball(NoMotion{});
  c.shape = SphereShape{{0, 0, 0}, 0};
  EXPECT_EQ(text(c), "colliders[0].shape.sphere.radius: 0 must be greater than 0");
  c.shape = CapsuleShape{{1, 1, 1}, {1, 1, 1}, 1};
  EXPECT_EQ(text(c), "colliders[0].shape.capsule.to: must be another point than \"from\"");
  c.shape = BoxShape{{0, 0, 0}, {1, 0, 1}};
  EXPECT_EQ(text(c), "colliders[0].shape.box.max[1]: 0 must be greater than min[1] = 0");
  c.shape = PlaneShape{{0, 0, 0}, {0, 0, 0}};
  EXPECT_EQ(text(c), "colliders[0].shape.plane.normal: must not be 0");
  c = ball(KeyframeMotion{{{1, {}, {}}, {1, {}, {}}}, {}});
  EXPECT_EQ(text(c), "colliders[0].motion.keyframes[1].time: 1 must be later than that of the keyframe before, 1");
  c = ball(NoMotion{});
  c.material = 1;
  EXPECT_EQ(text(c), "colliders[0].material: is no material of the scene");
  scene.colliders = {ball(NoMotion{}), ball(NoMotion{})};
  EXPECT_EQ(validate(scene).at(0).where, "colliders[1].name");
}

}  // namespace
}  // namespace hooke
