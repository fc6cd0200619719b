// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/render/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hooke/render/action.h"

namespace hooke {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

double norm(const Vec3d& v) { return std::sqrt(dot(v, v)); }
Vec3d normalized(const Vec3d& v) { return (1 / norm(v)) * v; }

double angle(const Vec3d& a, const Vec3d& b) { return std::acos(std::clamp(dot(a, b) / norm(a) / norm(b), -1.0, 1.0)); }

void expect_near(const Vec3d& a, const Vec3d& b, double tolerance = 1e-9) { EXPECT_LE(norm(a - b), tolerance); }

// Where a point falls onto the picture: -1 to 1 from rim to rim; depth > 0 before the eye.
struct Place {
  double x, y, depth;
};
Place place(const render::Camera& camera, double aspect, const Vec3d& point) {
  const render::CameraAxes own = render::axes(camera);
  const Vec3d to = point - camera.eye;
  const double depth = -dot(to, own.back), half = depth * std::tan(0.5 * camera.field_of_view * kDegree);
  return {dot(to, own.right) / (half * aspect), dot(to, own.up) / half, depth};
}

struct Extent {
  double left = 2, right = -2, bottom = 2, top = -2;
};
Extent extent(const render::Camera& camera, double aspect, const Box3d& box) {
  Extent all;
  for (int i = 0; i < 8; ++i) {
    const Place p = place(
        camera, aspect, {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z});
    EXPECT_GT(p.depth, 0);
    all = {std::min(all.left, p.x), std::max(all.right, p.x), std::min(all.bottom, p.y), std::max(all.top, p.y)};
  }
  return all;
}

TEST(DefaultCamera, ShowsAllOfABoxAndFillsThePictureWithIt) {
  const Box3d boxes[] = {{{0, 0, 0}, {64, 24, 16}},
                         {{-1, -1, -1}, {1, 1, 1}},
                         {{5, 0, -9}, {6, 0.1, 40}},
                         {{0, 0, 0}, {1, 50, 1}},
                         {{1e6, 2e6, 0}, {1e6 + 3, 2e6 + 1, 2}},
                         {{0, 0, 0}, {1e-4, 2e-4, 1e-4}}};
  const Vec3d ups[] = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, -1, 0}, normalized({1, 2, 3}), normalized({0.1, 1, 0})};
  for (const Box3d& box : boxes) {
    for (const Vec3d& up : ups) {
      for (const double aspect : {16.0 / 9, 1.0, 0.4, 4.0}) {
        for (const double field_of_view : {10.0, 35.0, 100.0}) {
          SCOPED_TRACE(testing::Message()
                       << "box to " << box.max.x << ' ' << box.max.y << ' ' << box.max.z << ", up " << up.x << ' '
                       << up.y << ' ' << up.z << ", aspect " << aspect << ", " << field_of_view << " degrees");
          const Extent e = extent(render::default_camera(box, up, field_of_view, aspect), aspect, box);
          EXPECT_GE(std::min(e.left, e.bottom), -1);
          EXPECT_LE(std::max(e.right, e.top), 1);
          EXPECT_GE(std::max(e.right - e.left, e.top - e.bottom) / 2, 0.85);
          if (field_of_view > 35) continue;
          EXPECT_NEAR(e.left, -e.right, 0.3);  // about in the middle
        }
      }
    }
  }
}

TEST(DefaultCamera, LooksFromALittleAboveWithTheLongSideAcross) {
  const Box3d box{{0, 0, 0}, {64, 24, 16}};
  const render::Camera camera = render::default_camera(box, {0, 1, 0}, 35, 16.0 / 9);
  EXPECT_GT(camera.eye.y, box.max.y);
  EXPECT_GT(std::abs(render::axes(camera).right.x), 0.8);
  EXPECT_EQ(camera.up, (Vec3d{0, 1, 0}));
  // The camera's up follows the given up.
  for (const Vec3d& up : {Vec3d{0, 0, 1}, Vec3d{0, -1, 0}, Vec3d{1, 0, 0}}) {
    EXPECT_GT(dot(render::axes(render::default_camera(box, up, 35, 1)).up, up), 0.8);
  }
}

TEST(Axes, AreUnitVectorsAndRightHanded) {
  const render::CameraAxes own = render::axes({{3, 4, 5}, {-1, 2, 0}, normalized({0.3, 1, 0.1}), 35});
  for (const Vec3d& axis : {own.right, own.up, own.back}) EXPECT_NEAR(norm(axis), 1, 1e-12);
  EXPECT_NEAR(dot(own.right, own.up), 0, 1e-12);
  EXPECT_NEAR(dot(own.right, own.back), 0, 1e-12);
  expect_near({own.right.y * own.up.z - own.right.z * own.up.y, own.right.z * own.up.x - own.right.x * own.up.z,
               own.right.x * own.up.y - own.right.y * own.up.x},
              own.back, 1e-12);
  expect_near(own.back, normalized({4, 2, 5}), 1e-12);
}

Scene tank() {
  Scene scene;
  scene.domain.max = {8, 6, 4};
  scene.materials.resize(1);
  scene.materials[0].radius = 0.5;
  return scene;
}

TEST(CameraAt, IsTheScenesWhereThatSays) {
  Scene scene = tank();
  const Box3d box{scene.domain.min, scene.domain.max};
  const render::Camera own = render::camera_at(scene, box, 1.5, 0);
  expect_near(own.eye, render::default_camera(box, {0, 1, 0}, 35, 1.5).eye);

  scene.camera.target = Vec3d{1, 2, 3};  // seen from the same side
  render::Camera camera = render::camera_at(scene, box, 1.5, 0);
  expect_near(camera.target, {1, 2, 3});
  expect_near(camera.eye - camera.target, own.eye - own.target);

  scene.camera.eye = Vec3d{-20, 9, 30};
  camera = render::camera_at(scene, box, 1.5, 7);  // no orbit: the same at any time
  expect_near(camera.eye, {-20, 9, 30});
  expect_near(camera.target, {1, 2, 3});

  scene.camera.target.reset();
  scene.camera.field_of_view = 80;
  camera = render::camera_at(scene, box, 1.5, 0);
  expect_near(camera.eye, {-20, 9, 30});
  EXPECT_EQ(camera.field_of_view, 80);
}

TEST(CameraAt, OrbitTurnsAroundWhatPointsUp) {
  for (const Vec3d& gravity : {Vec3d{0, -9.8, 0}, Vec3d{0, 0, -9.8}, Vec3d{-1, -2, -3}}) {
    Scene scene = tank();
    scene.gravity = gravity;
    scene.camera.orbit = 12;
    const Box3d box{scene.domain.min, scene.domain.max};
    const Vec3d up = render::up_of(scene);
    const render::Camera first = render::camera_at(scene, box, 1.5, 0), later = render::camera_at(scene, box, 1.5, 2.5),
                         whole = render::camera_at(scene, box, 1.5, 30);
    expect_near(later.target, first.target);
    EXPECT_NEAR(norm(later.eye - later.target), norm(first.eye - first.target), 1e-9);
    EXPECT_NEAR(dot(later.eye - first.eye, up), 0, 1e-9);  // at the same height
    const auto level = [&](const Vec3d& v) { return v - dot(v, up) * up; };
    EXPECT_NEAR(angle(level(first.eye - first.target), level(later.eye - later.target)), 30 * kDegree, 1e-9);
    expect_near(whole.eye, first.eye, 1e-8);
  }
}

TEST(CameraAt, LooksStraightDownToo) {
  for (const double height : {50.0, -50.0}) {
    Scene scene = tank();
    scene.camera.target = Vec3d{4, 0, 2};
    scene.camera.eye = Vec3d{4, height, 2};
    const render::Camera camera = render::camera_at(scene, {scene.domain.min, scene.domain.max}, 1.5, 0);
    const render::CameraAxes own = render::axes(camera);
    EXPECT_NEAR(norm(own.right), 1, 1e-9);
    EXPECT_NEAR(norm(own.up), 1, 1e-9);
    EXPECT_NEAR(own.up.y, 0, 1e-9);
    const Place middle = place(camera, 1.5, {4, 3, 2});
    EXPECT_NEAR(middle.x, 0, 1e-9);
    EXPECT_NEAR(middle.y, 0, 1e-9);
  }
}

TEST(UpOf, IsAgainstGravity) {
  Scene scene;
  scene.gravity = {0, 0, -2};
  expect_near(render::up_of(scene), {0, 0, 1});
  scene.gravity = {3, -4, 0};
  expect_near(render::up_of(scene), {-0.6, 0.8, 0});
  scene.gravity = {0, 0, 0};
  expect_near(render::up_of(scene), {0, 1, 0});
}

ParticleSet at(const std::vector<Vec3d>& positions) {
  ParticleSet particles;
  particles.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    particles.id[i] = i + 1;
    particles.position[i] = positions[i];
  }
  return particles;
}

TEST(ActionBox, IsAsHighAsTheParticlesReachAndABit) {
  Scene scene = tank();
  scene.domain.max.y = 100;
  Box3d box = render::action_box(scene, at({{1, 1, 1}, {2, 3.5, 1}}));
  expect_near(box.min, {0, 0, 0});
  expect_near(box.max, {8, 1.15 * 4, 4});
  // Gravity the other way: from the ceiling down.
  scene.gravity = {0, 9.8, 0};
  box = render::action_box(scene, at({{1, 97, 1}}));
  expect_near(box.min, {0, 100 - 1.15 * 3.5, 0});
  expect_near(box.max, {8, 100, 4});
}

TEST(ActionBox, IsTheDomainWhereThatIsAllThereIs) {
  Scene scene = tank();
  expect_near(render::action_box(scene, {}).max, {8, 6, 4});
  expect_near(render::action_box(scene, at({{1, 5.9, 1}})).max, {8, 6, 4});
}

TEST(ActionBox, IsAroundWhatIsThereWhereTheDomainIsFarLarger) {
  Scene scene = tank();
  scene.domain = {{-500, 0, -500}, {500, 400, 500}, {Boundary::open, Boundary::spring, Boundary::open}};
  const ParticleSet start = at({{-1, 2, -1}, {1, 4, 1}});
  Box3d box = render::action_box(scene, start);
  EXPECT_LT(box.max.x - box.min.x, 20);
  EXPECT_TRUE(box.contains({-1.5, 0, -1.5}) && box.contains({1.5, 4.5, 1.5}));

  // What the run is seen to do counts, without the odd particle that flies away.
  std::vector<ParticleSet> moments{start, start};
  for (int k = 0; k < 500; ++k) {
    moments[1].id.push_back(moments[1].id.size() + 1);
    moments[1].material.push_back(0);
    moments[1].position.push_back({k == 400 ? 400.0 : 10.0 + 0.01 * k, 0.5, 0});
    moments[1].velocity.push_back({0, 0, 0});
  }
  box = render::seen_action_box(scene, moments);
  EXPECT_GT(box.max.x, 15);
  EXPECT_LT(box.max.x, 20);
  EXPECT_EQ(box.min.y, 0);
}

TEST(CameraAt, GoesSmoothlyThroughItsKeyframes) {
  Scene scene = tank();
  const Box3d box{scene.domain.min, scene.domain.max};
  scene.camera.eye = Vec3d{10, 0, 0};
  scene.camera.target = Vec3d{0, 0, 0};
  scene.camera.keyframes = {
      {1, Vec3d{10, 1, 0}, {}, {}, {}}, {3, Vec3d{12, 1, 4}, Vec3d{1, 0, 0}, 50, 20}, {4, {}, {}, {}, {}}};
  expect_near(render::camera_at(scene, box, 1, 0).eye, {10, 1, 0});
  expect_near(render::camera_at(scene, box, 1, 3).eye, {12, 1, 4});
  expect_near(render::camera_at(scene, box, 1, 3).target, {1, 0, 0});
  EXPECT_EQ(render::camera_at(scene, box, 1, 3).field_of_view, 50);
  expect_near(render::camera_at(scene, box, 1, 9).eye, {10, 0, 0});
  EXPECT_EQ(render::camera_at(scene, box, 1, 9).field_of_view, 35);
  for (double time = 0.5; time < 4.5; time += 0.01) {
    const Vec3d step = render::camera_at(scene, box, 1, time + 1e-4).eye - render::camera_at(scene, box, 1, time).eye;
    const Vec3d next =
        render::camera_at(scene, box, 1, time + 2e-4).eye - render::camera_at(scene, box, 1, time + 1e-4).eye;
    EXPECT_LT(norm(next - step), 1e-6) << "no jump, no sudden turn at " << time;
  }
}

TEST(CameraAt, RollsClockwise) {
  Scene scene = tank();
  scene.camera.eye = Vec3d{0, 0, 10};
  scene.camera.target = Vec3d{0, 0, 0};
  scene.camera.roll = 90;
  expect_near(render::axes(render::camera_at(scene, {scene.domain.min, scene.domain.max}, 1, 0)).up, {1, 0, 0});
}

TEST(CameraAt, FollowsAMaterialOrACollider) {
  Scene scene = tank();
  scene.camera.eye = Vec3d{0, 0, 10};
  scene.camera.target = Vec3d{0, 0, 0};
  const ParticleSet particles = at({{1, 2, 3}, {3, 2, 3}});
  EXPECT_FALSE(render::followed_point(scene, particles, 0));
  scene.camera.follow = CameraFollow{0, {}};
  const auto middle = render::followed_point(scene, particles, 0);
  ASSERT_TRUE(middle);
  expect_near(*middle, {2, 2, 3});
  const render::Camera camera = render::camera_at(scene, {scene.domain.min, scene.domain.max}, 1, 0, middle);
  expect_near(camera.target, {2, 2, 3});
  expect_near(camera.eye, {2, 2, 13});
  EXPECT_FALSE(render::followed_point(scene, {}, 0)) << "nothing of it is there";
  scene.colliders.resize(1);
  scene.colliders[0].shape = SphereShape{{1, 1, 1}, 0.5};
  scene.colliders[0].motion = SteadyMotion{{2, 0, 0}, {0, 0, 0}, {}};
  scene.camera.follow = CameraFollow{{}, 0};
  expect_near(*render::followed_point(scene, particles, 1.5), {4, 1, 1});
}

TEST(DirectionToSun, IsHighAndOnTheSideOfTheDefaultCamera) {
  for (const Vec3d& up : {Vec3d{0, 1, 0}, Vec3d{0, 0, 1}, normalized({1, 2, 3})}) {
    const Box3d box{{0, 0, 0}, {8, 6, 4}};
    const Vec3d sun = render::direction_to_sun(box, up);
    EXPECT_NEAR(norm(sun), 1, 1e-12);
    EXPECT_GT(dot(sun, up), 0.5);
    const render::CameraAxes own = render::axes(render::default_camera(box, up, 35, 1.5));
    EXPECT_GT(dot(sun, own.back), 0);
    EXPECT_GT(dot(sun, own.right), 0);
  }
}

}  // namespace
}  // namespace hooke
