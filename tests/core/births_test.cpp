// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The random quantities of births: their distributions against the requested ones. Seeds are fixed, so that no test
// fails by chance.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "hooke/core/births.h"

namespace hooke::test {
namespace {

constexpr std::uint64_t kDraws = 40000;

// Pearson's chi-square of `kBins` bins that should be equally full: with 19 degrees of freedom, 1 in 10,000 is above
// 50.8.
constexpr std::size_t kBins = 20;
constexpr double kLimit = 50.8;
class Histogram {
 public:
  void add(double share) {  // position within the range, 0 to 1
    ASSERT_GE(share, 0);
    ASSERT_LE(share, 1);
    ++bins_[std::min(static_cast<std::size_t>(share * kBins), kBins - 1)];
    ++count_;
  }
  double chi_square() const {
    const double expected = static_cast<double>(count_) / kBins;
    double sum = 0;
    for (const std::uint64_t n : bins_) {
      sum += (static_cast<double>(n) - expected) * (static_cast<double>(n) - expected) / expected;
    }
    return sum;
  }

 private:
  std::array<std::uint64_t, kBins> bins_{};
  std::uint64_t count_ = 0;
};

Emitter emitter_of(Shape shape) {
  Emitter e;
  e.shape = std::move(shape);
  e.seed = 7;
  return e;
}

TEST(Births, SpeedsAreEvenAndDirectionsFillTheCone) {
  for (const double spread : {15.0, 90.0, 180.0}) {
    Emitter e = emitter_of(DiscShape{});
    e.speed = {2, 3};
    e.direction = {1, 2, -0.5};
    e.spread = spread;
    const PlacedEmitter placed = place_emitter(e, 0, 0, 0);
    const Vec3d axis = (1 / std::sqrt(dot(e.direction, e.direction))) * e.direction;
    const Vec3d off = cross(axis, {0, 0, 1}), across = (1 / std::sqrt(dot(off, off))) * off;
    const double narrow = 1 - std::cos(spread * M_PI / 180);
    Histogram speed, cosine, azimuth;
    for (std::uint64_t n = 0; n < kDraws; ++n) {
      const Vec3d v = draw_velocity(placed, n, {0, 0, 0});
      const double length = std::sqrt(dot(v, v));
      speed.add(length - 2);
      // Rounding changes the cosine by a few 1e-16.
      cosine.add(std::clamp((1 - dot(v, axis) / length) / narrow, 0.0, 1.0));
      azimuth.add(0.5 + std::atan2(dot(v, across), dot(v, cross(axis, across))) / (2 * M_PI));
    }
    EXPECT_LT(speed.chi_square(), kLimit) << spread;
    EXPECT_LT(cosine.chi_square(), kLimit) << spread;
    EXPECT_LT(azimuth.chi_square(), kLimit) << spread;
  }
}

TEST(Births, PlacesFillTheShapeEvenly) {
  const Vec3d from{1, 2, 3}, to{4, 1, 5}, along = to - from;
  const double length = std::sqrt(dot(along, along));
  Histogram disc, sphere, height, radius, capsule;
  const Emitter in_disc = emitter_of(DiscShape{from, along, 0.5}), in_sphere = emitter_of(SphereShape{from, 0.5}),
                in_cylinder = emitter_of(CylinderShape{from, to, 0.5}),
                in_capsule = emitter_of(CapsuleShape{from, to, 0.5});

  for (std::uint64_t n = 0; n < kDraws; ++n) {
    const Vec3d d = draw_position(place_emitter(in_disc, 0, 0, 0), n, 0) - from;
    EXPECT_NEAR(dot(d, along), 0, 1e-14);
    disc.add(dot(d, d) / 0.25);
    const Vec3d s = draw_position(place_emitter(in_sphere, 0, 0, 0), n, 0) - from;
    sphere.add(std::pow(dot(s, s) / 0.25, 1.5));
    const Vec3d c = draw_position(place_emitter(in_cylinder, 0, 0, 0), n, 0) - from;
    const double h = dot(c, along) / length;
    height.add(h / length);
    radius.add((dot(c, c) - h * h) / 0.25);
    const Vec3d p = draw_position(place_emitter(in_capsule, 0, 0, 0), n, 0) - from;
    const double at = dot(p, along) / (length * length);
    if (at >= 0 && at <= 1) capsule.add(at);
  }
  for (const Histogram* h : {&disc, &sphere, &height, &radius, &capsule}) EXPECT_LT(h->chi_square(), kLimit);
}

// A life lasts the n steps for which n dt decay >= life > (n - 1) dt decay, so the number of steps tells life and
// decay: both must be evenly distributed.
TEST(Births, LivesAreEvenAndDecayEatsThem) {
  Emitter e = emitter_of(DiscShape{});
  e.life = Range{1, 3};
  const double dt = 1e-5;
  Histogram life;
  for (std::uint64_t n = 0; n < kDraws; ++n) {
    const auto steps = draw_lifetime(e, 0, n, dt);
    ASSERT_TRUE(steps);
    life.add(std::min((static_cast<double>(*steps) * dt - 1) / 2, 1.0));
  }
  EXPECT_LT(life.chi_square(), kLimit);

  e.life = Range{1, 1};
  e.decay = {0.8, 1.2};
  Histogram decay;
  for (std::uint64_t n = 0; n < kDraws; ++n) {
    const auto steps = static_cast<double>(*draw_lifetime(e, 0, n, dt));
    decay.add(std::clamp((1 / (steps * dt) - 0.8) / 0.4, 0.0, 1.0));
  }
  EXPECT_LT(decay.chi_square(), kLimit);
}

TEST(Births, ALifeIsOverOnTheStepThatUsesItUp) {
  Emitter e = emitter_of(DiscShape{});
  for (const auto& [life, dt, steps] : {std::tuple{1.0, 0.1, 10}, {1.0, 0.3, 4}, {0.05, 0.1, 1}, {0.7, 0.1, 7}}) {
    e.life = Range{life, life};
    EXPECT_EQ(draw_lifetime(e, 0, 0, dt), steps) << life << " s";
  }
  e.life.reset();
  EXPECT_FALSE(draw_lifetime(e, 0, 0, 0.1));
}

TEST(Births, EmittersOfOneSeedDrawDifferently) {
  const Emitter e = emitter_of(SphereShape{{0, 0, 0}, 1});
  EXPECT_NE(draw_position(place_emitter(e, 0, 0, 0), 3, 0), draw_position(place_emitter(e, 1, 0, 0), 3, 0));
  EXPECT_NE(draw_position(place_emitter(e, 0, 0, 0), 3, 0), draw_position(place_emitter(e, 0, 0, 0), 3, 1));
  EXPECT_NE(draw_position(place_emitter(e, 0, 0, 0), 3, 0), draw_position(place_emitter(e, 0, 0, 0), 4, 0));
}

TEST(Births, AMovingEmitterGivesItsMotion) {
  Emitter e = emitter_of(DiscShape{{1, 0, 0}, {0, 1, 0}, 1e-9});
  e.speed = {2, 2};
  // A quarter of a turn about z through the origin takes (1, 0, 0) to (0, 1, 0), and +y to -x.
  e.motion = SteadyMotion{{0, 0, 5}, {0, 0, M_PI / 2}, Vec3d{0, 0, 0}};
  const PlacedEmitter placed = place_emitter(e, 0, 1, 0);
  const Vec3d x = draw_position(placed, 0, 0), v = draw_velocity(placed, 0, x);
  const Vec3d expected_x{0, 1, 5}, expected_v{-2 - M_PI / 2, 0, 5};
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(component(x, axis), component(expected_x, axis), 2e-9);  // the disc's radius
    EXPECT_NEAR(component(v, axis), component(expected_v, axis), 4e-9);
  }
}

}  // namespace
}  // namespace hooke::test
