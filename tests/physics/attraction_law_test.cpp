// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hooke/physics/attraction.h"

namespace hooke {
namespace {

// The largest relative error of inverse_root() over all orders of magnitude that attraction uses, each swept in steps
// that share no pattern with its bits.
template <class Real>
double worst_inverse_root(int lowest, int highest) {
  double worst = 0;
  for (int order = lowest; order < highest; ++order) {
    for (double mantissa = 1; mantissa < 2; mantissa += 0.00313) {
      const Real a = static_cast<Real>(std::ldexp(mantissa, order));
      const long double root = 1 / std::sqrt(static_cast<long double>(a));
      worst = std::max(worst, static_cast<double>(std::abs(inverse_root(a) / root - 1)));
    }
  }
  return worst;
}

// Three roundings of at most half an epsilon each add up in the result.
TEST(InverseRoot, IsRightToTheLastDigits) {
  EXPECT_LT(worst_inverse_root<float>(-80, 81), 1.5 * std::numeric_limits<float>::epsilon());
  EXPECT_LT(worst_inverse_root<double>(-80, 81), 1.5 * std::numeric_limits<double>::epsilon());
  EXPECT_LT(worst_inverse_root<double>(-300, -200), 1.5 * std::numeric_limits<double>::epsilon());
}

TEST(Attraction, IsNewtonsAndSoftenedPlummers) {
  const Vec3d towards{3, -4, 12};
  EXPECT_NEAR(attraction<ExactMath>(towards, 7.0, 1e-30) * 13 * 13 * 13, 7, 1e-14);
  EXPECT_NEAR(attraction<ExactMath>(towards, 7.0, 27.0) * 14 * 14 * 14, 7, 1e-14);
  EXPECT_NEAR(attraction_potential<ExactMath>(towards, 7.0, 27.0), -0.5, 1e-15);
}

// The expansion of a cloud of eight masses, far away, against the sum of the pulls of its masses. The next term of the
// expansion is smaller by the cloud's size over its distance.
class CloudOfMasses : public testing::Test {
 protected:
  static constexpr double kSize = 0.01;  // relative to the distance, which is about 1
  const Vec3d centre_{0.6, -0.5, 0.62};
  std::vector<std::pair<Vec3d, double>> masses_;
  MassCloud<double> cloud_{};

  CloudOfMasses() {
    Vec3d moment{0, 0, 0};
    for (int k = 0; k < 8; ++k) {
      const Vec3d at = kSize * Vec3d{std::cos(1.0 + k * k), std::sin(2.0 + k), 0.5 * std::cos(3.0 * k)};
      const double mass = 1 + 0.25 * k;
      masses_.emplace_back(at, mass);
      cloud_.mass += mass;
      moment += mass * at;
    }
    for (auto& [at, mass] : masses_) {
      at -= (1 / cloud_.mass) * moment;
      cloud_.xx += 3 * mass * at.x * at.x;
      cloud_.xy += 3 * mass * at.x * at.y;
      cloud_.xz += 3 * mass * at.x * at.z;
      cloud_.yy += 3 * mass * at.y * at.y;
      cloud_.yz += 3 * mass * at.y * at.z;
      cloud_.zz += 3 * mass * at.z * at.z;
      cloud_.trace += 1.5 * mass * dot(at, at);
    }
  }
};

TEST_F(CloudOfMasses, PullsLikeItsParts) {
  for (const double softening2 : {1e-30, 0.3}) {
    Vec3d sum{0, 0, 0};
    double potential = 0;
    for (const auto& [at, mass] : masses_) {
      sum += attraction<ExactMath>(centre_ + at, mass, softening2) * (centre_ + at);
      potential += attraction_potential<ExactMath>(centre_ + at, mass, softening2);
    }
    const Vec3d off = cloud_attraction<ExactMath>(centre_, cloud_, softening2) - sum;
    // The error is the octupoles, a few size^3 times the mass; without quadrupoles it would be size^2.
    EXPECT_LT(std::sqrt(dot(off, off)), 10 * kSize * kSize * kSize * cloud_.mass) << softening2;
    EXPECT_NEAR(cloud_potential<ExactMath>(centre_, cloud_, softening2), potential,
                5 * kSize * kSize * kSize * cloud_.mass);
  }
}

}  // namespace
}  // namespace hooke
