// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/physics/contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hooke/base/random.h"

namespace hooke {
namespace {

struct Row {
  const char* what;
  double overlap;
  Vec3d normal, w;
  ContactCoefficients<double> c;
  Vec3d force;
  double dissipation;
};

// Worked out by hand from F = k overlap n + c_s w_t + c_d w, and dissipation = (c_s w_t + c_d w) . w.
const Row kTable[] = {
    {"spring alone", 0.25, {1, 0, 0}, {0, 0, 0}, {1000, 5, 3}, {250, 0, 0}, 0},
    {"spring along -y", 0.5, {0, -1, 0}, {0, 0, 0}, {8, 5, 3}, {0, -4, 0}, 0},
    {"approach: both push apart", 0.25, {1, 0, 0}, {2, 0, 0}, {1000, 5, 3}, {256, 0, 0}, 12},
    {"release: the dashpot holds back", 0.25, {1, 0, 0}, {-2, 0, 0}, {1000, 5, 3}, {244, 0, 0}, 12},
    {"release: the whole force may attract", 0.001, {1, 0, 0}, {-2, 0, 0}, {1000, 5, 3}, {-5, 0, 0}, 12},
    {"sliding: shear and damping add up", 0.25, {1, 0, 0}, {0, 2, 0}, {1000, 5, 3}, {250, 16, 0}, 32},
    {"sliding along z", 0.25, {1, 0, 0}, {0, 0, -4}, {1000, 5, 3}, {250, 0, -32}, 128},
    {"oblique", 0.25, {1, 0, 0}, {2, 2, -4}, {1000, 5, 3}, {256, 16, -32}, 172},
    {"damping only, whole velocity", 0.125, {0, 0, 1}, {1, 2, 3}, {0, 0, 2}, {2, 4, 6}, 28},
    {"shear only, tangential part", 0.125, {0, 0, 1}, {1, 2, 3}, {0, 2, 0}, {2, 4, 0}, 10},
    {"no coefficients", 0.125, {0, 0, 1}, {1, 2, 3}, {0, 0, 0}, {0, 0, 0}, 0},
    {"normal 3-4-5", 5, {0.6, 0.8, 0}, {0, 0, 0}, {10, 1, 1}, {30, 40, 0}, 0},
    {"normal 3-4-5, along it", 5, {0.6, 0.8, 0}, {3, 4, 0}, {10, 7, 2}, {36, 48, 0}, 50},
    {"normal 3-4-5, across it", 5, {0.6, 0.8, 0}, {-4, 3, 0}, {10, 1, 2}, {18, 49, 0}, 75},
};

TEST(ContactForce, GivesTheValuesWorkedOutByHand) {
  for (const Row& row : kTable) {
    const ContactForces<double> parts = contact_forces(row.overlap, row.normal, row.w, row.c);
    const Vec3d f = parts.total();
    EXPECT_NEAR(f.x, row.force.x, 1e-13) << row.what;
    EXPECT_NEAR(f.y, row.force.y, 1e-13) << row.what;
    EXPECT_NEAR(f.z, row.force.z, 1e-13) << row.what;
    EXPECT_NEAR(dot(parts.shear + parts.damping, row.w), row.dissipation, 1e-13) << row.what;
  }
}

TEST(ContactForce, InSinglePrecisionIsTheSameLaw) {
  for (const Row& row : kTable) {
    const ContactCoefficients<float> c{static_cast<float>(row.c.stiffness), static_cast<float>(row.c.shear),
                                       static_cast<float>(row.c.damping)};
    const auto f =
        contact_forces(static_cast<float>(row.overlap), vec_cast<float>(row.normal), vec_cast<float>(row.w), c).total();
    EXPECT_NEAR(f.x, row.force.x, 1e-4) << row.what;
    EXPECT_NEAR(f.y, row.force.y, 1e-4) << row.what;
    EXPECT_NEAR(f.z, row.force.z, 1e-4) << row.what;
  }
}

// Two random particles, passed to the law as the engine does.
template <class R>
struct RandomPair {
  Vec3<R> x_1, x_2, v_1, v_2;
  R reach;
  ContactCoefficients<R> c;

  explicit RandomPair(std::uint64_t index) {
    const auto a = uniform4(1, index, 0), b = uniform4(1, index, 1), d = uniform4(1, index, 2),
               e = uniform4(1, index, 3);
    const auto r = [](double value) { return static_cast<R>(value); };
    const Vec3<R> from{r(20 * a[0] - 10), r(20 * a[1] - 10), r(20 * a[2] - 10)};
    x_1 = from;
    x_2 = from + Vec3<R>{r(b[0] - 0.5), r(b[1] - 0.5), r(b[2] - 0.5)};
    v_1 = {r(d[0] - 0.5), r(d[1] - 0.5), r(d[2] - 0.5)};
    v_2 = {r(e[0] - 0.5), r(e[1] - 0.5), r(e[2] - 0.5)};
    reach = r(1);
    c = {r(1000 * a[3]), r(5 * b[3]), r(3 * d[3])};
  }

  struct Contact {
    Vec3<R> force;
    R dissipation;  // by both dashpots
  };

  // The force on the particle at x from the particle at y.
  static Contact force(const Vec3<R>& x, const Vec3<R>& y, const Vec3<R>& v, const Vec3<R>& u, R tie, R reach,
                       const ContactCoefficients<R>& c) {
    const Vec3<R> x_ip = x - y;
    const R distance = sqrt_of(dot(x_ip, x_ip));
    const ContactForces<R> f = contact_forces(reach - distance, contact_normal(x_ip, distance, tie), u - v, c);
    return {f.total(), dot(f.shear + f.damping, u - v)};
  }
  Contact on_1() const { return force(x_1, x_2, v_1, v_2, R(-1), reach, c); }
  Contact on_2() const { return force(x_2, x_1, v_2, v_1, R(1), reach, c); }
};

template <class R>
class ContactForceOf : public testing::Test {};
using NumberTypes = testing::Types<float, double>;
TYPED_TEST_SUITE(ContactForceOf, NumberTypes);

TYPED_TEST(ContactForceOf, ObeysNewtonsThirdLawToTheBit) {
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const RandomPair<TypeParam> pair(i);
    const auto on_1 = pair.on_1(), on_2 = pair.on_2();
    ASSERT_EQ(on_1.force, -on_2.force) << i;
    ASSERT_EQ(on_1.dissipation, on_2.dissipation) << i;
  }
}

TYPED_TEST(ContactForceOf, NeverGivesEnergyThroughItsDashpots) {
  constexpr TypeParam kRounding = 4 * std::numeric_limits<TypeParam>::epsilon();
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const RandomPair<TypeParam> pair(i);
    const auto w = pair.v_2 - pair.v_1;
    ASSERT_GE(pair.on_1().dissipation, -kRounding * pair.c.shear * dot(w, w)) << i;
  }
}

// Coefficients can be applied to the sum over contacts instead of to each contact.
TEST(ContactForce, IsLinearInItsVectors) {
  const ContactCoefficients<double> c{1000, 5, 3};
  ContactVectors<double> sum;
  ContactForces<double> forces;
  for (const Row& row : kTable) {
    sum += contact_vectors(row.overlap, row.normal, row.w);
    forces += contact_forces(row.overlap, row.normal, row.w, c);
  }
  const Vec3d off = contact_forces(sum, c).total() - forces.total();
  EXPECT_LT(std::sqrt(dot(off, off)), 1e-11) << "of 1e4 N";
  EXPECT_GT(forces.spring.x, 1000);
}

TYPED_TEST(ContactForceOf, PushesCoincidentCentresApartByTheirIds) {
  using R = TypeParam;
  for (std::uint64_t i = 0; i < 100; ++i) {
    RandomPair<R> pair(i);
    pair.x_2 = pair.x_1;
    const auto on_1 = pair.on_1(), on_2 = pair.on_2();
    ASSERT_TRUE(std::isfinite(on_1.force.x) && std::isfinite(on_1.force.y) && std::isfinite(on_1.force.z));
    ASSERT_EQ(on_1.force, -on_2.force);
    pair.v_2 = pair.v_1;
    ASSERT_EQ(pair.on_1().force.x, -pair.c.stiffness * pair.reach) << "the lower id goes to -x";
  }
}

// Frames that move with a velocity at which nothing rounds give the same bits; other reference frames the same up to
// rounding.
TYPED_TEST(ContactForceOf, IsTheSameInAMovingFrame) {
  using R = TypeParam;
  constexpr R kEpsilon = std::numeric_limits<R>::epsilon();
  for (std::uint64_t i = 0; i < 5000; ++i) {
    RandomPair<R> pair(i);
    const auto grid = [](R value) { return std::nearbyint(value * R(64)) / R(64); };
    pair.v_1 = {grid(pair.v_1.x), grid(pair.v_1.y), grid(pair.v_1.z)};
    pair.v_2 = {grid(pair.v_2.x), grid(pair.v_2.y), grid(pair.v_2.z)};
    const auto at_rest = pair.on_1();
    const Vec3<R> frame{R(3.5), R(-20), R(0.25)};
    pair.v_1 += frame;
    pair.v_2 += frame;
    ASSERT_EQ(pair.on_1().force, at_rest.force);
    pair.v_1 += {R(0.1), R(0.3), R(-0.7)};
    pair.v_2 += {R(0.1), R(0.3), R(-0.7)};
    const Vec3<R> difference = pair.on_1().force - at_rest.force;
    ASSERT_LT(std::sqrt(dot(difference, difference)), 8 * 25 * 10 * kEpsilon);
  }
}

// The smallest numbers: no division by a distance that underflowed to 0.
TYPED_TEST(ContactForceOf, IsFiniteForTheSmallestDistances) {
  using R = TypeParam;
  for (const R tiny : {std::numeric_limits<R>::denorm_min(), std::numeric_limits<R>::min(),
                       std::sqrt(std::numeric_limits<R>::denorm_min()), R(1e-30), R(1e-20)}) {
    const Vec3<R> x_ip{tiny, 0, 0};
    const R distance = sqrt_of(dot(x_ip, x_ip));
    const Vec3<R> n = contact_normal(x_ip, distance, R(1));
    EXPECT_TRUE(std::isfinite(n.x)) << tiny;
    EXPECT_LE(std::abs(n.x), R(1.5)) << tiny << ": a unit vector but for the rounding of denormal squares";
  }
}

TEST(ContactNormal, HasLengthOne) {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const RandomPair<double> pair(i);
    const Vec3d x_ip = pair.x_1 - pair.x_2;
    const Vec3d n = contact_normal(x_ip, std::sqrt(dot(x_ip, x_ip)), 1.0);
    EXPECT_NEAR(dot(n, n), 1, 1e-15);
    EXPECT_GT(dot(n, x_ip), 0) << "from the partner to i";
  }
}

TEST(ContactEnergy, IsHalfKTimesSquare) {
  EXPECT_EQ(contact_energy(0.5, 8.0), 1);
  EXPECT_EQ(contact_energy(0.0, 8.0), 0);
}

}  // namespace
}  // namespace hooke
