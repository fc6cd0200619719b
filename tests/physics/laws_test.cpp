// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <cmath>

#include "hooke/physics/drag.h"
#include "hooke/physics/integrate.h"
#include "hooke/physics/stability.h"
#include "hooke/physics/wall.h"

namespace hooke {
namespace {

TEST(Drag, ActsAgainstTheVelocity) {
  EXPECT_EQ(drag_force(Vec3d{1, -2, 4}, 0.5), (Vec3d{-0.5, 1, -2}));
  EXPECT_EQ(drag_force(Vec3d{1, -2, 4}, 0.0), (Vec3d{0, 0, 0}));
}

TEST(Wall, OverlapIsRadiusLessDistance) {
  EXPECT_EQ(lower_wall_overlap(0.25, 0.0, 0.5), 0.25);
  EXPECT_EQ(lower_wall_overlap(-9.75, -10.0, 0.5), 0.25);
  EXPECT_EQ(lower_wall_overlap(1.0, 0.0, 0.5), -0.5);
  EXPECT_EQ(upper_wall_overlap(9.75, 10.0, 0.5), 0.25);
  EXPECT_EQ(upper_wall_overlap(10.25, 10.0, 0.5), 0.75) << "also with the centre beyond the face";
}

TEST(Wall, NormalsPointIntoTheDomain) {
  EXPECT_EQ(wall_normal(0, 1.0), (Vec3d{1, 0, 0}));
  EXPECT_EQ(wall_normal(1, -1.0), (Vec3d{0, -1, 0}));
  EXPECT_EQ(wall_normal(2, 1.0), (Vec3d{0, 0, 1}));
}

TEST(Integrate, KickAndDriftAddARate) {
  EXPECT_EQ(kick(Vec3d{1, 2, 3}, Vec3d{4, -8, 16}, 0.25), (Vec3d{2, 0, 7}));
  EXPECT_EQ(drift(Vec3d{1, 2, 3}, Vec3d{4, -8, 16}, 0.25), (Vec3d{2, 0, 7}));
}

TEST(EffectiveMass, OfPairsAndWalls) {
  EXPECT_EQ(effective_mass(2, 2), 1);
  EXPECT_EQ(effective_mass(1, 3), 0.75);
  EXPECT_EQ(effective_mass(3, INFINITY), 3);
  EXPECT_EQ(effective_mass(INFINITY, 3), 3);
}

TEST(DampingRatio, IsOneWhereCritical) {
  EXPECT_EQ(damping_ratio(2 * std::sqrt(400 * 0.25), 400, 0.25), 1);
  EXPECT_EQ(damping_ratio(3, 0, 1), 0);
  // From the first reference case: K 1000, Kd 3, m_eff 1/2.
  EXPECT_NEAR(damping_ratio(3, 1000, 0.5), 0.0671, 5e-5);
}

TEST(CriticalStep, SolvesItsEquation) {
  EXPECT_DOUBLE_EQ(critical_step(4, 0), 1) << "2/omega";
  EXPECT_DOUBLE_EQ(critical_step(0, 4), 0.5) << "2/gamma";
  EXPECT_EQ(critical_step(0, 0), INFINITY);
  for (const double omega2 : {1e-6, 1.0, 1e6}) {
    for (const double gamma : {0.0, 1e-3, 1.0, 1e3, 1e9}) {
      const double dt = critical_step(omega2, gamma);
      EXPECT_NEAR(omega2 * dt * dt + 2 * gamma * dt, 4, 1e-12) << omega2 << ' ' << gamma;
    }
  }
}

// The recurrence v += dt a; x += dt v for x'' = -omega2 x - gamma x' grows above the critical step and decays below.
TEST(CriticalStep, IsWhereSymplecticEulerTurnsUnstable) {
  for (const double gamma : {0.0, 0.3, 3.0}) {
    const double critical = critical_step(1, gamma);
    const auto largest_after = [&](double dt) {
      double x = 1, v = 0, largest = 0;
      for (int i = 0; i < 5000; ++i) {
        v += dt * (-x - gamma * v);
        x += dt * v;
        largest = std::max(largest, std::abs(x));
      }
      return largest;
    };
    EXPECT_LT(largest_after(0.99 * critical), 10) << gamma;
    EXPECT_FALSE(largest_after(1.01 * critical) < 1e10) << gamma;
  }
}

}  // namespace
}  // namespace hooke
