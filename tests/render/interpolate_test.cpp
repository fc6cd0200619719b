// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/render/interpolate.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hooke {
namespace {

struct Row {
  std::uint64_t id;
  Vec3d position, velocity;
};

ParticleSet particles(const std::vector<Row>& rows) {
  ParticleSet set;
  set.resize(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    set.id[i] = rows[i].id;
    set.position[i] = rows[i].position;
    set.velocity[i] = rows[i].velocity;
  }
  return set;
}

void expect_near(const Vec3d& a, const Vec3d& b, double tolerance = 1e-12) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

Scene box() {
  Scene scene;
  scene.domain.max = {10, 10, 10};
  return scene;
}

TEST(Interpolate, GoesThroughBothEnds) {
  const ParticleSet a = particles({{1, {1, 2, 3}, {4, -5, 6}}}), b = particles({{1, {3, 1, 2}, {-1, 2, 9}}});
  const render::Moment before{2, a}, after{2.5, b};
  const ParticleSet first = render::interpolate(box(), before, after, 2),
                    last = render::interpolate(box(), before, after, 2.5);
  EXPECT_EQ(first.position, a.position);
  EXPECT_EQ(first.velocity, a.velocity);
  expect_near(last.position[0], b.position[0]);
  expect_near(last.velocity[0], b.velocity[0]);
  // The path leaves and arrives with the velocities of both ends.
  constexpr double h = 1e-6;
  const ParticleSet soon = render::interpolate(box(), before, after, 2 + h),
                    late = render::interpolate(box(), before, after, 2.5 - h);
  expect_near((1 / h) * (soon.position[0] - a.position[0]), a.velocity[0], 1e-3);
  expect_near((1 / h) * (b.position[0] - late.position[0]), b.velocity[0], 1e-3);
}

TEST(Interpolate, UniformMotionIsStraight) {
  const Vec3d x{1, 2, 3}, v{4, 5, -6};
  const ParticleSet a = particles({{7, x, v}}), b = particles({{7, x + 0.5 * v, v}});
  for (const double t : {0.1, 0.25, 0.4}) {
    const ParticleSet now = render::interpolate(box(), {0, a}, {0.5, b}, t);
    expect_near(now.position[0], x + t * v);
    expect_near(now.velocity[0], v);
  }
}

TEST(Interpolate, AFallIsAParabola) {
  const Vec3d x{1, 9, 3}, v{1, 2, 0}, g{0, -9.8, 0};
  const auto at = [&](double t) { return x + t * v + (0.5 * t * t) * g; };
  const ParticleSet a = particles({{7, x, v}}), b = particles({{7, at(0.8), v + 0.8 * g}});
  for (const double t : {0.1, 0.4, 0.7}) {
    const ParticleSet now = render::interpolate(box(), {0, a}, {0.8, b}, t);
    expect_near(now.position[0], at(t));
    expect_near(now.velocity[0], v + t * g);
  }
}

TEST(Interpolate, CrossesAPeriodicFaceTheShortWay) {
  Scene scene = box();
  scene.domain.boundary[0] = Boundary::periodic;
  const Vec3d v{10, 0, 0};
  const ParticleSet a = particles({{1, {9.8, 5, 5}, v}, {2, {0.2, 5, 5}, -v}});
  const ParticleSet b = particles({{1, {0.2, 5, 5}, v}, {2, {9.8, 5, 5}, -v}});
  const auto at = [&](double t) { return render::interpolate(scene, {0, a}, {0.04, b}, t); };
  expect_near(at(0.01).position[0], {9.9, 5, 5});
  expect_near(at(0.03).position[0], {0.1, 5, 5});
  expect_near(at(0.01).position[1], {0.1, 5, 5});
  expect_near(at(0.03).position[1], {9.9, 5, 5});
  // Between walls the particle has moved the long way.
  scene.domain.boundary[0] = Boundary::spring;
  expect_near(at(0.02).position[0], {5, 5, 5});
}

TEST(Interpolate, WhoLeavesGoesOnAndWhoComesWaits) {
  const ParticleSet a = particles({{2, {1, 1, 1}, {1, 0, 0}}, {5, {4, 1, 1}, {0, 2, 0}}, {9, {7, 1, 1}, {0, 0, 3}}});
  const ParticleSet b = particles({{1, {8, 8, 8}, {0, 0, 0}}, {5, {4, 2, 1}, {0, 2, 0}}, {11, {9, 9, 9}, {0, 0, 0}}});
  const ParticleSet now = render::interpolate(box(), {0, a}, {0.5, b}, 0.25);
  EXPECT_EQ(now.id, a.id);
  expect_near(now.position[0], {1.25, 1, 1});
  expect_near(now.position[1], {4, 1.5, 1});
  expect_near(now.position[2], {7, 1, 1.75});
}

TEST(Interpolate, OfNothingNothing) {
  const ParticleSet none, some = particles({{1, {1, 1, 1}, {1, 0, 0}}});
  EXPECT_TRUE(render::interpolate(box(), {0, none}, {1, none}, 0.5).empty());
  EXPECT_TRUE(render::interpolate(box(), {0, none}, {1, some}, 0.5).empty());
  EXPECT_EQ(render::interpolate(box(), {0, some}, {1, none}, 0.5).size(), 1u);
  EXPECT_EQ(render::interpolate(box(), {1, some}, {1, some}, 1).position, some.position);  // no time between them
}

TEST(DrawnBack, IsWhereParticlesComeFrom) {
  const ParticleSet now = particles({{3, {1, 2, 3}, {10, -20, 5}}});
  const ParticleSet then = render::drawn_back(box(), now, 0.1);
  expect_near(then.position[0], {0, 4, 2.5});
  EXPECT_EQ(then.velocity, now.velocity);
  EXPECT_EQ(then.id, now.id);
  EXPECT_EQ(render::drawn_back(box(), now, 0).position, now.position);
}

TEST(DrawnBack, StaysInAPeriodicDomain) {
  Scene scene = box();
  scene.domain.boundary[0] = Boundary::periodic;
  const ParticleSet now = particles({{3, {0.5, 0.5, 3}, {10, 10, 0}}});
  expect_near(render::drawn_back(scene, now, 0.1).position[0], {9.5, -0.5, 3});
}

}  // namespace
}  // namespace hooke
