// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/neighbours/motion_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "hooke/base/random.h"

namespace hooke {
namespace {

constexpr double kDiameter = 1;
constexpr double kSkin = 0.25;
constexpr std::size_t kGroup = 4;

// Displacement, after some steps, of point i that was listed at x.
using Motion = std::function<Vec3d(const Vec3d& x, std::uint64_t i, double steps)>;

Vec3d noise(std::uint64_t i, double size) {
  const auto u = uniform4(31, i, 0);
  return {size * (2 * u[0] - 1), size * (2 * u[1] - 1), size * (2 * u[2] - 1)};
}

// Points in a box of `size`, and reference frames that follow their motion.
class Bounded {
 public:
  Bounded(std::size_t count, const Vec3d& size, bool periodic) : size_(size), periodic_(periodic) {
    std::vector<double> columns[3];
    for (std::size_t i = 0; i < count; ++i) {
      const auto u = uniform4(30, i, 0);
      x_.push_back({u[0] * size.x, u[1] * size.y, u[2] * size.z});
    }
    // Sorted so that the points of a window lie close together.
    const auto row = [](const Vec3d& x) { return std::pair(std::floor(x.z / 1.5), std::floor(x.y / 1.5)); };
    std::sort(x_.begin(), x_.end(),
              [&](const Vec3d& a, const Vec3d& b) { return row(a) != row(b) ? row(a) < row(b) : a.x < b.x; });
    for (const Vec3d& x : x_) {
      columns[0].push_back(x.x);
      columns[1].push_back(x.y);
      columns[2].push_back(x.z);
    }
    bounds_.lay_out({columns[0].data(), columns[1].data(), columns[2].data()}, count, kGroup,
                    {kDiameter, kSkin, {periodic, periodic, periodic}, {0, 0, 0}, size});
    frames_.resize((count + kGroup - 1) / kGroup);
  }

  // Point `gone` does not exist any more.
  std::int64_t follow(const Motion& motion, double steps, std::size_t gone = std::numeric_limits<std::size_t>::max()) {
    return bounds_.follow(
        [&](std::size_t g) {
          MotionBounds<double>::WindowMotion sum;
          for (std::size_t i = g * kGroup; i < std::min((g + 1) * kGroup, x_.size()); ++i) {
            if (i == gone) continue;
            const Vec3d now = motion(x_[i], i, steps);
            sum.moved += now;
            sum.step += motion(x_[i], i, steps + 1) - now;
            sum.count += 1;
          }
          return sum;
        },
        frames_);
  }

  // Whether point i, moved by u, is further from its reference frame than allowed, `steps` steps after follow().
  bool outliers(std::size_t i, const Vec3d& u, double steps) const {
    const Vec3d off = u - frames_[i / kGroup].at(steps);
    return !(dot(off, off) <= frames_[i / kGroup].limit2(steps));
  }
  std::size_t outlier_count(const Motion& motion, double followed, double steps) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) count += outliers(i, motion(x_[i], i, followed + steps), steps) ? 1 : 0;
    return count;
  }

  // Pairs that were not listed and touch once each point has moved by motion(x, i, steps).
  std::vector<std::pair<std::size_t, std::size_t>> touching(const Motion& motion, double steps) const {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      for (std::size_t p = 0; p < i; ++p) {
        if (distance(x_[i] - x_[p]) < kDiameter + kSkin) continue;
        const Vec3d now = x_[i] + motion(x_[i], i, steps) - (x_[p] + motion(x_[p], p, steps));
        if (distance(now) < kDiameter) pairs.emplace_back(i, p);
      }
    }
    return pairs;
  }

  const MotionBounds<double>& bounds() const { return bounds_; }
  const std::vector<ReferenceFrame<double>>& frames() const { return frames_; }
  const std::vector<Vec3d>& points() const { return x_; }
  double distance(Vec3d d) const {
    for (int axis = 0; axis < 3 && periodic_; ++axis) {
      const double length = component(size_, axis);
      component(d, axis) -= length * std::nearbyint(component(d, axis) / length);
    }
    return std::sqrt(dot(d, d));
  }

 private:
  Vec3d size_;
  bool periodic_;
  std::vector<Vec3d> x_;
  MotionBounds<double> bounds_;
  std::vector<ReferenceFrame<double>> frames_;
};

struct Setting {
  std::size_t count;
  Vec3d size;
};
const Setting kSettings[] = {
    {400, {9, 9, 9}}, {400, {60, 3, 20}}, {200, {5e4, 5e4, 5e4}}, {2, {9, 9, 9}}, {1, {9, 9, 9}}};

// Several ways to move, each a little further with every step.
const Motion kMotions[] = {
    [](const Vec3d&, std::uint64_t i, double t) { return t * noise(i, 0.02); },
    [](const Vec3d&, std::uint64_t i, double t) { return t * noise(i, 0.1); },
    [](const Vec3d&, std::uint64_t i, double t) { return i == 7 ? t * Vec3d{0.7, 0.2, 0} : Vec3d{0, 0, 0}; },
    [](const Vec3d&, std::uint64_t i, double t) { return i % 50 == 0 ? t * noise(i, 5) : Vec3d{0, 0, 0}; },
    [](const Vec3d& x, std::uint64_t, double t) { return Vec3d{-0.05 * t * x.x, 0, 0}; },
    [](const Vec3d& x, std::uint64_t, double t) { return Vec3d{0.01 * t * x.z, 0, -0.01 * t * x.x}; },
    [](const Vec3d& x, std::uint64_t, double t) { return Vec3d{x.x < 4 ? 0.1 * t : -0.1 * t, 0, 0}; },
    [](const Vec3d& x, std::uint64_t, double t) { return Vec3d{x.x < 4 ? 0.02 * t * t : -0.02 * t * t, 1, 0}; },
};

// Of two points that touch without being listed, at least one is an outlier, as long as the reference frames are good.
TEST(MotionBounds, NeverMissATouchOfTwoThatAreNoOutliers) {
  int questions = 0, kept = 0;
  for (const Setting& setting : kSettings) {
    for (const bool periodic : {false, true}) {
      Bounded bounded(setting.count, setting.size, periodic);
      for (const Motion& motion : kMotions) {
        for (const double followed : {0.0, 3.0}) {
          const std::int64_t good_for = bounded.follow(motion, followed);
          for (int steps = 0; steps <= std::min<std::int64_t>(good_for, 20); ++steps) {
            ++kept;
            for (const auto& [i, p] : bounded.touching(motion, followed + steps)) {
              ++questions;
              const auto outliers = [&](std::size_t k) {
                return bounded.outliers(k, motion(bounded.points()[k], k, followed + steps), steps);
              };
              ASSERT_TRUE(outliers(i) || outliers(p)) << i << ", " << p << " after " << steps << " of " << good_for;
            }
          }
        }
      }
    }
  }
  EXPECT_GT(questions, 1000) << "the question was put";
  EXPECT_GT(kept, 500) << "the question was put";
}

// A search around an outlier relies on this: a particle that touches the outlier and is no outlier itself lies within
// the searched distance.
TEST(MotionBounds, SayWhereNeighboursOfOutliersAre) {
  int mild = 0, far = 0;
  for (const bool periodic : {false, true}) {
    Bounded bounded(400, {9, 9, 9}, periodic);
    for (const Motion& motion : kMotions) {
      const std::int64_t good_for = bounded.follow(motion, 0);
      for (int steps = 0; steps <= std::min<std::int64_t>(good_for, 20); ++steps) {
        const auto moved = [&](std::size_t k) { return motion(bounded.points()[k], k, steps); };
        for (const auto& [a, b] : bounded.touching(motion, steps)) {
          for (const auto& [i, p] : {std::pair{a, b}, std::pair{b, a}}) {
            if (!bounded.outliers(i, moved(i), steps) || bounded.outliers(p, moved(p), steps)) continue;
            const ReferenceFrame<double>& frame = bounded.frames()[i / kGroup];
            const Vec3d off = moved(i) - frame.at(steps), now = bounded.points()[i] + moved(i);
            const bool is_mild = std::sqrt(dot(off, off)) < MotionBounds<double>::kMild * kSkin;
            const Vec3d drift = is_mild ? frame.at(steps) : bounded.bounds().middle(steps);
            const double apart =
                is_mild ? bounded.bounds().frames_apart(frame, steps) : bounded.bounds().furthest_from_middle(steps);
            ASSERT_LE(bounded.distance(bounded.points()[p] - (now - drift)), kDiameter + kSkin / 2 + apart);
            ++(is_mild ? mild : far);
          }
        }
      }
    }
  }
  EXPECT_GT(mild, 30) << "the question was put";
  EXPECT_GT(far, 50) << "the question was put";
}

// One fast grain makes no other grain an outlier.
TEST(MotionBounds, FindOnlyTheFastGrainAnOutlier) {
  Bounded bounded(2000, {60, 3, 20}, false);
  const Motion motion = [](const Vec3d&, std::uint64_t i, double t) {
    return i == 1234 ? Vec3d{0.4 * t, 0, 0} : Vec3d{};
  };
  ASSERT_GT(bounded.follow(motion, 0), 10);
  EXPECT_EQ(bounded.outlier_count(motion, 0, 1), 1U);
  EXPECT_EQ(bounded.outlier_count(motion, 0, 10), 1U);
}

TEST(MotionBounds, FollowWhatMovesTogether) {
  for (const Setting& setting : kSettings) {
    Bounded bounded(setting.count, setting.size, false);
    const Motion together = [](const Vec3d&, std::uint64_t i, double t) {
      return t * Vec3d{5, -1, 0.2} + noise(i, 0.05);
    };
    ASSERT_GT(bounded.follow(together, 3), 15);
    EXPECT_EQ(bounded.outlier_count(together, 3, 0), 0U);
    EXPECT_EQ(bounded.outlier_count(together, 3, 15), 0U);
  }
}

TEST(MotionBounds, FollowASmallShearOfALongPool) {
  Bounded bounded(200, {60, 1, 1}, false);
  // The pool's ends move apart by more than a diameter, neighbours by a fiftieth.
  const Motion shear = [](const Vec3d& x, std::uint64_t, double t) { return Vec3d{0.002 * t * x.x, 0, 0}; };
  ASSERT_GT(bounded.follow(shear, 0), 10);
  EXPECT_EQ(bounded.outlier_count(shear, 0, 2), 0U);
}

TEST(MotionBounds, CallWhatIsNotFiniteAnOutlier) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Bounded bounded(300, {9, 9, 9}, false);
    const Motion motion = [bad](const Vec3d&, std::uint64_t i, double) { return Vec3d{0, i == 123 ? bad : 0.0, 0}; };
    const std::int64_t good_for = bounded.follow(motion, 1);
    EXPECT_TRUE(good_for < 0 || bounded.outliers(123, motion({}, 123, 1), 0));
    ASSERT_GE(bounded.follow([](const Vec3d&, std::uint64_t, double) { return Vec3d{}; }, 0), 0);
    EXPECT_TRUE(bounded.outliers(123, {bad, bad, bad}, 1));
  }
}

TEST(MotionBounds, IgnoreTheDeparted) {
  Bounded bounded(300, {9, 9, 9}, false);
  const Motion motion = [](const Vec3d&, std::uint64_t i, double t) { return Vec3d{0, i == 5 ? 1e9 * t : 0.0, 0}; };
  ASSERT_GT(bounded.follow(motion, 1, 5), 100);
  EXPECT_EQ(bounded.outlier_count(motion, 1, 0), 1U) << "all but the one that is gone are where they were";
}

// Frames very far from the listed positions would be too coarse because of rounding.
TEST(MotionBounds, GiveUpAfterAVeryLongWay) {
  Bounded bounded(300, {9, 9, 9}, false);
  EXPECT_LT(bounded.follow([](const Vec3d&, std::uint64_t, double t) { return Vec3d{t, 0, 0}; }, 1e6), 0);
}

TEST(MotionBounds, OfNothingAreGood) {
  Bounded bounded(0, {9, 9, 9}, false);
  EXPECT_GE(bounded.follow([](const Vec3d&, std::uint64_t, double) { return Vec3d{}; }, 0), 0);
}

}  // namespace
}  // namespace hooke
