// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/neighbours/motion_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "hooke/base/random.h"

namespace hooke {
namespace {

constexpr double kDiameter = 1;
constexpr double kSkin = 0.25;

using Field = std::function<Vec3d(const Vec3d& x, std::uint64_t i)>;

Vec3d noise(std::uint64_t i, double size) {
  const auto u = uniform4(31, i, 0);
  return {size * (2 * u[0] - 1), size * (2 * u[1] - 1), size * (2 * u[2] - 1)};
}

// Points in a box of `size`, and what the bounds say of them after a displacement.
class Bounded {
 public:
  Bounded(std::size_t count, const Vec3d& size, bool periodic) : size_(size), periodic_(periodic) {
    std::vector<double> columns[3];
    for (std::size_t i = 0; i < count; ++i) {
      const auto u = uniform4(30, i, 0);
      x_.push_back({u[0] * size.x, u[1] * size.y, u[2] * size.z});
      columns[0].push_back(x_.back().x);
      columns[1].push_back(x_.back().y);
      columns[2].push_back(x_.back().z);
    }
    // Any order will do; points of one block next to each other save memory and time.
    bounds_.lay_out({columns[0].data(), columns[1].data(), columns[2].data()}, count,
                    {kDiameter, kSkin, {periodic, periodic, periodic}, {0, 0, 0}, size});
  }

  bool may_touch(const Field& field) {
    return bounds_.unlisted_pair_may_touch([&](std::size_t i, Vec3d& u) {
      u = field(x_[i], i);
      return true;
    });
  }

  // Whether a pair that was not listed touches now, by looking at every one.
  bool touches(const Field& field) const {
    for (std::size_t i = 0; i < x_.size(); ++i) {
      for (std::size_t p = 0; p < i; ++p) {
        if (distance(x_[i] - x_[p]) < kDiameter + kSkin) continue;
        if (distance(x_[i] + field(x_[i], i) - (x_[p] + field(x_[p], p))) < kDiameter) return true;
      }
    }
    return false;
  }

  MotionBounds<double>& bounds() { return bounds_; }

 private:
  double distance(Vec3d d) const {
    for (int axis = 0; axis < 3 && periodic_; ++axis) {
      const double length = component(size_, axis);
      component(d, axis) -= length * std::nearbyint(component(d, axis) / length);
    }
    return std::sqrt(dot(d, d));
  }

  Vec3d size_;
  bool periodic_;
  std::vector<Vec3d> x_;
  MotionBounds<double> bounds_;
};

struct Setting {
  std::size_t count;
  Vec3d size;
};
const Setting kSettings[] = {
    {400, {9, 9, 9}}, {400, {60, 3, 20}}, {200, {5e4, 5e4, 5e4}}, {2, {9, 9, 9}}, {1, {9, 9, 9}}};

TEST(MotionBounds, NeverTrustAListThatMissesATouch) {
  const Field fields[] = {
      [](const Vec3d&, std::uint64_t i) { return noise(i, 0.05); },
      [](const Vec3d&, std::uint64_t i) { return noise(i, 0.2); },
      [](const Vec3d&, std::uint64_t i) { return i == 7 ? Vec3d{4, 1, 0} : Vec3d{0, 0, 0}; },
      [](const Vec3d&, std::uint64_t i) { return i % 50 == 0 ? noise(i, 30) : Vec3d{0, 0, 0}; },
      [](const Vec3d& x, std::uint64_t) { return Vec3d{-0.4 * x.x, 0, 0}; },
      [](const Vec3d& x, std::uint64_t) { return Vec3d{0.05 * x.z, 0, -0.05 * x.x}; },
      [](const Vec3d& x, std::uint64_t) { return x.x < 4 ? Vec3d{0.6, 0, 0} : Vec3d{-0.6, 0, 0}; },
  };
  int touched = 0;
  for (const Setting& setting : kSettings) {
    for (const bool periodic : {false, true}) {
      Bounded bounded(setting.count, setting.size, periodic);
      for (const Field& field : fields) {
        if (!bounded.touches(field)) continue;
        ++touched;
        EXPECT_TRUE(bounded.may_touch(field)) << setting.count << " points, periodic " << periodic;
      }
    }
  }
  EXPECT_GT(touched, 8) << "the question was put";
}

TEST(MotionBounds, TrustWhatMovesTogether) {
  for (const Setting& setting : kSettings) {
    Bounded bounded(setting.count, setting.size, false);
    EXPECT_FALSE(bounded.may_touch([](const Vec3d&, std::uint64_t) { return Vec3d{0, 0, 0}; }));
    EXPECT_FALSE(bounded.may_touch([](const Vec3d&, std::uint64_t) { return Vec3d{100, -20, 3}; }));
    EXPECT_FALSE(bounded.may_touch([](const Vec3d&, std::uint64_t i) { return Vec3d{5, 0, 0} + noise(i, 0.05); }));
  }
}

TEST(MotionBounds, TrustASmallShearOfALargePool) {
  Bounded bounded(2000, {60, 3, 20}, false);
  // Ends of the pool move apart by three diameters, neighbours by a hundredth.
  EXPECT_FALSE(bounded.may_touch([](const Vec3d& x, std::uint64_t) { return Vec3d{0.01 * x.x, 0, 0}; }));
}

TEST(MotionBounds, DistrustWhatIsNotFinite) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Bounded bounded(300, {9, 9, 9}, false);
    EXPECT_TRUE(bounded.may_touch(
        [bad](const Vec3d&, std::uint64_t i) { return i == 123 ? Vec3d{0, bad, 0} : Vec3d{0, 0, 0}; }));
    EXPECT_TRUE(bounded.may_touch([bad](const Vec3d&, std::uint64_t) { return Vec3d{bad, bad, bad}; }));
  }
}

TEST(MotionBounds, IgnoreTheDeparted) {
  Bounded bounded(300, {9, 9, 9}, false);
  EXPECT_FALSE(bounded.bounds().unlisted_pair_may_touch([](std::size_t i, Vec3d& u) {
    u = {0, i == 5 ? 1e9 : 0.0, 0};
    return i != 5;
  }));
}

TEST(MotionBounds, OfNothingTrustEverything) {
  Bounded bounded(0, {9, 9, 9}, false);
  EXPECT_FALSE(bounded.may_touch([](const Vec3d&, std::uint64_t) { return Vec3d{0, 0, 0}; }));
}

}  // namespace
}  // namespace hooke
