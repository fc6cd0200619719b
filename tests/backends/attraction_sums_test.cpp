// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "clusters.h"
#include "hooke/backends/cpu/attraction_sums.h"
#include "hooke/backends/cpu/isa.h"
#include "hooke/base/threads.h"

namespace hooke {
namespace {

constexpr double kSoftening2 = 1e-8;

template <class Real>
AttractionLoops<Real> loops_of(const Isa& isa) {
  if constexpr (sizeof(Real) == 4) {
    return isa.single_loops.attraction;
  } else {
    return isa.double_loops.attraction;
  }
}

// Ids with gaps; some gaps are as long as whole blocks.
std::vector<std::uint64_t> ids_for(std::size_t count) {
  std::vector<std::uint64_t> ids(count);
  for (std::size_t i = 0; i < count; ++i) ids[i] = 100 + 3 * i + (i > count / 2 ? 5000 : 0);
  return ids;
}

template <class Real>
std::vector<AttractionPoint<Real>> points_at(const std::vector<Vec3d>& positions) {
  std::vector<AttractionPoint<Real>> points;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3<Real> x = vec_cast<Real>(positions[i]);
    const auto k = static_cast<std::uint32_t>(i);
    points.push_back({{x.x, x.y, x.z, static_cast<Real>(1 + i % 3)}, k, k});
  }
  return points;
}

struct Way {
  Attraction attraction;
  int threads = 1;
  std::string isa;
};

template <class Real>
AttractionSums<Real> sums_of(const Way& run) {
  AttractionSums<Real> sums;
  sums.configure(run.attraction, kSoftening2, loops_of<Real>(*choose_isa(run.isa)));
  return sums;
}

template <class Real>
std::vector<Vec3<Real>> pulls(std::vector<AttractionPoint<Real>> points, const Way& run) {
  std::vector<Vec3<Real>> a(points.size());
  auto sums = sums_of<Real>(run);
  Threads(run.threads).run([&] {
    sums.accelerations(points, points.size(), IdTable(ids_for(points.size())), a.data());
  });
  return a;
}

template <class Real>
std::vector<double> potentials(std::vector<AttractionPoint<Real>> points, const Way& run) {
  std::vector<double> potential(points.size());
  sums_of<Real>(run).potentials(points, points.size(), IdTable(ids_for(points.size())), potential.data());
  return potential;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

Way by(Attraction::Method method, double accuracy = 1e-3) {
  Way run;
  run.attraction.method = method;
  run.attraction.accuracy = accuracy;
  return run;
}
const Way kDirect = by(Attraction::Method::direct);

template <class Real>
double rms_error(const std::vector<Vec3<Real>>& a, const std::vector<Vec3d>& right) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3d off = vec_cast<double>(a[i]) - right[i];
    sum += dot(off, off) / dot(right[i], right[i]);
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(DirectAttraction, IsThePlainSumInBlocksOfIds) {
  const auto points = points_at<double>(bench::plummer_sphere(1500, 1, 10, 3));
  const auto ids = ids_for(points.size());
  const auto a = pulls(points, kDirect);
  const auto potential = potentials(points, kDirect);
  for (std::size_t i = 0; i < points.size(); i += 7) {
    Vec3d total{0, 0, 0}, block{0, 0, 0};
    double potential_total = 0, potential_block = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (p > 0 && ids[p] / 1024 != ids[p - 1] / 1024) {
        total += block;
        block = {0, 0, 0};
        potential_total += potential_block;
        potential_block = 0;
      }
      const auto& from = points[p].source;
      const auto& to = points[i].source;
      const Vec3d towards{from.x - to.x, from.y - to.y, from.z - to.z};
      block += attraction<ExactMath>(towards, from.mass, kSoftening2) * towards;
      if (p != i) potential_block += attraction_potential<ExactMath>(towards, from.mass, kSoftening2);
    }
    EXPECT_EQ(a[i], total + block) << i;
    EXPECT_EQ(potential[i], potential_total + potential_block) << i;
  }
}

template <class Real>
class AttractionBits : public testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(AttractionBits, Reals, );

TYPED_TEST(AttractionBits, AreTheSameForThreadsAndInstructionSets) {
  const auto points = points_at<TypeParam>(bench::plummer_sphere(3001, 1, 10, 3));
  for (const auto method : {Attraction::Method::direct, Attraction::Method::tree}) {
    Way run = by(method);
    const auto right = pulls(points, run);
    for (run.threads = 1; run.threads <= 8; run.threads += run.threads == 3 ? 5 : 1) {
      EXPECT_TRUE(same_bits(pulls(points, run), right)) << run.threads << " threads";
    }
    run.threads = 2;
    const auto potential = potentials(points, run);
    for (const Isa& isa : available_isas()) {
      run.isa = isa.name;
      EXPECT_TRUE(same_bits(pulls(points, run), right)) << isa.name;
      EXPECT_TRUE(same_bits(potentials(points, run), potential)) << isa.name;
    }
  }
}

// The order of particles in memory changes with every restart.
TYPED_TEST(AttractionBits, OfTheTreeDoNotDependOnTheOrderOfPoints) {
  auto positions = bench::two_clusters(2000, 1, 4);
  for (std::size_t i = 0; i < 100; ++i) positions[10 * i] = {0.5, 0.5, 0.5};  // ties
  auto points = points_at<TypeParam>(positions);
  const Way run = by(Attraction::Method::tree);
  const auto right = pulls(points, run);
  std::reverse(points.begin(), points.end());
  std::rotate(points.begin(), points.begin() + 700, points.end());
  EXPECT_TRUE(same_bits(pulls(points, run), right));
}

// Fast sums have other bits, and are as accurate up to a few units in the last place of single precision.
TYPED_TEST(AttractionBits, AreGivenUpForSpeedOnRequest) {
  const auto points = points_at<TypeParam>(bench::plummer_sphere(2000, 1, 10, 5));
  const auto reference = pulls(points_at<double>(bench::plummer_sphere(2000, 1, 10, 5)), kDirect);
  for (const Isa& isa : available_isas()) {
    for (const auto method : {Attraction::Method::direct, Attraction::Method::tree}) {
      Way run = by(method);
      run.isa = isa.name;
      const auto exact = pulls(points, run);
      run.attraction.exact = false;
      const auto fast = pulls(points, run);
      if (sizeof(TypeParam) == 4) {
        EXPECT_FALSE(same_bits(fast, exact)) << isa.name;
      }
      const double rounding = sizeof(TypeParam) == 4 ? 2e-6 : 1e-14;
      EXPECT_LT(rms_error(fast, reference), method == Attraction::Method::direct ? rounding : 1e-3) << isa.name;
    }
  }
}

struct Shape {
  const char* name;
  std::vector<Vec3d> (*positions)(std::size_t count);
};

class TreeAccuracy : public testing::TestWithParam<Shape> {};

// The tree keeps the requested accuracy, on 10,000 particles, in both precisions. It is not much better than requested:
// that would waste speed.
TEST_P(TreeAccuracy, IsKept) {
  const auto positions = GetParam().positions(10'000);
  const auto in_double = points_at<double>(positions);
  const auto right = pulls(in_double, kDirect);
  for (const double accuracy : {1e-2, 1e-3, 1e-5}) {
    const Way run = by(Attraction::Method::tree, accuracy);
    const double error = rms_error(pulls(in_double, run), right);
    EXPECT_LT(error, accuracy);
    EXPECT_GT(error, accuracy / 100);
    if (accuracy < 1e-4)
      continue;  // positions in single precision have errors of 1e-7 themselves, close pairs larger ones
    EXPECT_LT(rms_error(pulls(points_at<float>(positions), run), right), accuracy);
  }
}

TEST_P(TreeAccuracy, HoldsForPotentials) {
  const auto points = points_at<double>(GetParam().positions(3000));
  const auto right = potentials(points, kDirect);
  const auto by_tree = potentials(points, by(Attraction::Method::tree, 1e-3));
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(by_tree[i] / right[i], 1, 1e-2) << i;
  double total = 0, total_right = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    total += points[i].source.mass * by_tree[i];
    total_right += points[i].source.mass * right[i];
  }
  EXPECT_NEAR(total / total_right, 1, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, TreeAccuracy,
    testing::Values(Shape{"plummer", [](std::size_t n) { return bench::plummer_sphere(n, 1, 20, 1); }},
                    Shape{"disc", [](std::size_t n) { return bench::disc(n, 2, 1); }},
                    Shape{"cube", [](std::size_t n) { return bench::cube(n, 2, 1); }},
                    Shape{"two_clusters", [](std::size_t n) { return bench::two_clusters(n, 1, 1); }}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(AttractionTree, TakesAnyNumberOfParticlesAnywhere) {
  for (const std::size_t count : {0U, 1U, 2U, 16U, 17U, 65U, 200U}) {
    const std::vector<std::vector<Vec3d>> all{
        std::vector<Vec3d>(count, Vec3d{1, 2, 3}),  // all on one spot: no pull
        bench::cube(count, 1e-3, 2),
    };
    for (const auto& positions : all) {
      const auto points = points_at<double>(positions);
      const auto right = pulls(points, kDirect);
      const auto a = pulls(points, by(Attraction::Method::tree, 1e-6));
      for (std::size_t i = 0; i < count; ++i) {
        const Vec3d off = a[i] - right[i];
        EXPECT_LE(dot(off, off), 1e-10 * dot(right[i], right[i])) << i << " of " << count;
      }
    }
  }
}

// Particles on a line, each at a tenth of the distance of the one before: halving boxes alone would take a level for
// each particle.
TEST(AttractionTree, StaysShallow) {
  std::vector<Vec3d> positions;
  for (int i = 0; i < 250; ++i) positions.push_back({std::pow(10.0, -i), 0, 0});
  auto points = points_at<double>(positions);
  AttractionTree<double> tree;
  tree.build(points);
  std::vector<int> level(tree.nodes().size(), 1);
  int deepest = 0;
  for (std::size_t k = 0; k < tree.nodes().size(); ++k) {
    deepest = std::max(deepest, level[k]);
    const auto& node = tree.nodes()[k];
    if (node.child == 0) continue;
    level[node.child] = level[node.child + 1] = level[k] + 1;
  }
  EXPECT_LE(deepest, 1 + std::log(250 / 8.0) / std::log(8 / 7.0));
  EXPECT_GE(deepest, 5);
}

}  // namespace
}  // namespace hooke
