// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/neighbours/motion_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>

#include "hooke/base/random.h"

namespace hooke {
namespace {

constexpr double kDiameter = 1;
constexpr double kSkin = 0.25;
constexpr double kFound = 1.5;
constexpr std::size_t kGroup = 4;

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
                    {kDiameter, kSkin, kFound, {periodic, periodic, periodic}, {0, 0, 0}, size});
  }

  Trust judge(const Field& field) {
    return bounds_.judge(
        [&](std::size_t i, Vec3d& u) {
          u = field(x_[i], i);
          return true;
        },
        kGroup, restless_);
  }

  // Every pair that was not listed and touches now.
  std::vector<std::pair<std::size_t, std::size_t>> touching(const Field& field) const {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      for (std::size_t p = 0; p < i; ++p) {
        if (distance(x_[i] - x_[p]) < kDiameter + kSkin) continue;
        if (distance(x_[i] + field(x_[i], i) - (x_[p] + field(x_[p], p))) < kDiameter) pairs.emplace_back(i, p);
      }
    }
    return pairs;
  }

  // Whether a new search finds the pair: both are restless and were no further apart than it looks.
  bool is_found(const std::pair<std::size_t, std::size_t>& pair) const {
    return restless_[pair.first / kGroup] != 0 && restless_[pair.second / kGroup] != 0 &&
           distance(x_[pair.first] - x_[pair.second]) < kDiameter + kFound;
  }

  MotionBounds<double>& bounds() { return bounds_; }
  const std::vector<unsigned char>& restless() const { return restless_; }

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
  std::vector<unsigned char> restless_;
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
  int lost = 0, found = 0;
  for (const Setting& setting : kSettings) {
    for (const bool periodic : {false, true}) {
      Bounded bounded(setting.count, setting.size, periodic);
      for (const Field& field : fields) {
        const auto touching = bounded.touching(field);
        if (touching.empty()) continue;
        const Trust trust = bounded.judge(field);
        ASSERT_NE(trust, Trust::all) << setting.count << " points, periodic " << periodic;
        lost += trust == Trust::none ? 1 : 0;
        if (trust == Trust::none) continue;
        ++found;
        for (const auto& pair : touching) ASSERT_TRUE(bounded.is_found(pair)) << pair.first << ", " << pair.second;
      }
    }
  }
  EXPECT_GT(lost, 4) << "the question was put";
  EXPECT_GT(found, 4) << "the question was put";
}

// One fast grain takes the trust in those around it, and no more.
TEST(MotionBounds, DistrustOnlyWhatAFastGrainCanReach) {
  Bounded bounded(2000, {60, 3, 20}, false);
  const std::size_t fast = 1234;
  EXPECT_EQ(bounded.judge([](const Vec3d&, std::uint64_t i) { return Vec3d{i == fast ? 0.4 : 0.0, 0, 0}; }),
            Trust::some);
  EXPECT_EQ(bounded.restless()[fast / kGroup], 1);
  const auto restless = std::count(bounded.restless().begin(), bounded.restless().end(), 1);
  EXPECT_LT(restless, 100) << "of 500 groups, whose points are scattered here";
  EXPECT_EQ(bounded.judge([](const Vec3d&, std::uint64_t i) { return Vec3d{i == fast ? 1.6 : 0.0, 0, 0}; }),
            Trust::none);
}

TEST(MotionBounds, TrustWhatMovesTogether) {
  for (const Setting& setting : kSettings) {
    Bounded bounded(setting.count, setting.size, false);
    EXPECT_EQ(bounded.judge([](const Vec3d&, std::uint64_t) { return Vec3d{0, 0, 0}; }), Trust::all);
    EXPECT_EQ(bounded.judge([](const Vec3d&, std::uint64_t) { return Vec3d{100, -20, 3}; }), Trust::all);
    EXPECT_EQ(bounded.judge([](const Vec3d&, std::uint64_t i) { return Vec3d{5, 0, 0} + noise(i, 0.05); }), Trust::all);
  }
}

TEST(MotionBounds, TrustASmallShearOfALargePool) {
  Bounded bounded(2000, {60, 3, 20}, false);
  // Ends of the pool move apart by three diameters, neighbours by a hundredth.
  EXPECT_EQ(bounded.judge([](const Vec3d& x, std::uint64_t) { return Vec3d{0.01 * x.x, 0, 0}; }), Trust::all);
}

TEST(MotionBounds, DistrustWhatIsNotFinite) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Bounded bounded(300, {9, 9, 9}, false);
    EXPECT_EQ(
        bounded.judge([bad](const Vec3d&, std::uint64_t i) { return i == 123 ? Vec3d{0, bad, 0} : Vec3d{0, 0, 0}; }),
        Trust::none);
    EXPECT_EQ(bounded.judge([bad](const Vec3d&, std::uint64_t) { return Vec3d{bad, bad, bad}; }), Trust::none);
  }
}

TEST(MotionBounds, IgnoreTheDeparted) {
  Bounded bounded(300, {9, 9, 9}, false);
  std::vector<unsigned char> restless;
  const auto displacement = [](std::size_t i, Vec3d& u) {
    u = {0, i == 5 ? 1e9 : 0.0, 0};
    return i != 5;
  };
  EXPECT_EQ(bounded.bounds().judge(displacement, kGroup, restless), Trust::all);
}

// Scratch memory may hold anything, and may be too small.
TEST(MotionBounds, JudgeTheSameInScratchMemory) {
  Bounded bounded(400, {9, 9, 9}, true);
  const auto displacement = [](std::size_t i, Vec3d& u) {
    u = noise(i, i == 7 ? 0.5 : 0.05);
    return true;
  };
  std::vector<unsigned char> restless, in_scratch;
  ASSERT_EQ(bounded.bounds().judge(displacement, kGroup, restless), Trust::some);
  for (const std::size_t size : {0U, 1U, 1000U, 1000000U}) {
    std::vector<double> scratch(size, 1e9);
    EXPECT_EQ(bounded.bounds().judge(displacement, kGroup, in_scratch, std::as_writable_bytes(std::span(scratch))),
              Trust::some);
    EXPECT_EQ(in_scratch, restless);
  }
}

TEST(MotionBounds, OfNothingTrustEverything) {
  Bounded bounded(0, {9, 9, 9}, false);
  EXPECT_EQ(bounded.judge([](const Vec3d&, std::uint64_t) { return Vec3d{0, 0, 0}; }), Trust::all);
}

}  // namespace
}  // namespace hooke
