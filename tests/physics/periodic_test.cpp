// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/physics/periodic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hooke/base/random.h"

namespace hooke {
namespace {

template <class R>
class Periodic : public testing::Test {};
using NumberTypes = testing::Types<float, double>;
TYPED_TEST_SUITE(Periodic, NumberTypes);

TYPED_TEST(Periodic, DisplacementsFollowTheirFormula) {
  using R = TypeParam;
  EXPECT_EQ(image_displacement(R(9), R(1), R(1), R(10)), R(-2));
  EXPECT_EQ(image_displacement(R(1), R(9), R(-1), R(10)), R(2));
  EXPECT_EQ(image_displacement(R(1), R(9), R(0), R(10)), R(-8));
  EXPECT_EQ(image_displacement(R(1), R(9), R(-2), R(10)), R(12));
}

TYPED_TEST(Periodic, NearestImageTurnsOverAtHalfALength) {
  using R = TypeParam;
  EXPECT_EQ(nearest_image(R(9), R(1), R(10)), R(1));
  EXPECT_EQ(nearest_image(R(1), R(9), R(10)), R(-1));
  EXPECT_EQ(nearest_image(R(5), R(1), R(10)), R(0));
  EXPECT_EQ(nearest_image(R(6), R(1), R(10)), R(0)) << "just half: both images are as near";
  EXPECT_EQ(nearest_image(R(1), R(6), R(10)), R(0));
  EXPECT_EQ(nearest_image(std::nextafter(R(6), R(7)), R(1), R(10)), R(1));
}

TYPED_TEST(Periodic, DisplacementsAreAntisymmetricToTheBit) {
  using R = TypeParam;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const auto u = uniform4(5, i, 0);
    const R length = static_cast<R>(0.1 + 10 * u[2]);
    const R a = static_cast<R>(u[0]) * length, b = static_cast<R>(u[1]) * length;
    const R ab = image_displacement(a, b, nearest_image(a, b, length), length);
    const R ba = image_displacement(b, a, nearest_image(b, a, length), length);
    ASSERT_EQ(ab, -ba);
    ASSERT_LE(std::abs(ab), length / 2);
  }
}

TYPED_TEST(Periodic, WrappingLeavesTheInsideAlone) {
  using R = TypeParam;
  for (const R x : {R(-2), R(-1.5), R(0), R(0.1), R(2.9), std::nextafter(R(3), R(0))}) {
    EXPECT_EQ(wrap_coordinate(x, R(-2), R(3)), x);
  }
}

TYPED_TEST(Periodic, WrappingBringsBackFromBothFaces) {
  using R = TypeParam;
  EXPECT_EQ(wrap_coordinate(R(3), R(-2), R(3)), R(-2)) << "the upper face is the lower one";
  EXPECT_EQ(wrap_coordinate(R(3.5), R(-2), R(3)), R(-1.5));
  EXPECT_EQ(wrap_coordinate(R(-2.5), R(-2), R(3)), R(2.5));
  EXPECT_EQ(wrap_coordinate(R(503.5), R(-2), R(3)), R(-1.5)) << "by a hundred lengths";
  EXPECT_EQ(wrap_coordinate(R(-502.5), R(-2), R(3)), R(2.5));
}

TYPED_TEST(Periodic, WrappedIsAlwaysInside) {
  using R = TypeParam;
  const R edges[][2] = {{R(0), R(1)}, {R(-2), R(3)}, {R(0.1), R(0.7)}, {R(-1e6), R(-1e6 + 1)}, {R(1000), R(1000.3)}};
  for (const auto& [min, max] : edges) {
    const auto inside = [&](R x) {
      const R wrapped = wrap_coordinate(x, min, max);
      EXPECT_GE(wrapped, min) << x;
      EXPECT_LT(wrapped, max) << x;
    };
    R below = min, above = max;
    for (int i = 0; i < 50; ++i) {
      inside(below);
      inside(above);
      below = std::nextafter(below, -INFINITY);
      above = std::nextafter(above, R(INFINITY));
    }
    inside(min - std::numeric_limits<R>::denorm_min());
    for (std::uint64_t i = 0; i < 5000; ++i) {
      const auto u = uniform4(6, i, 0);
      inside(static_cast<R>(min + (u[0] - 0.5) * 5));
      inside(static_cast<R>((u[1] - 0.5) * 1e8 * static_cast<double>(max - min)));
    }
  }
}

TYPED_TEST(Periodic, WrappingLeavesTheLostToTheStep) {
  using R = TypeParam;
  EXPECT_TRUE(std::isnan(wrap_coordinate(R(NAN), R(0), R(1))));
  EXPECT_EQ(wrap_coordinate(R(INFINITY), R(0), R(1)), R(INFINITY));
  EXPECT_EQ(wrap_coordinate(R(-1e20), R(0), R(1)), R(-1e20));
}

}  // namespace
}  // namespace hooke
