// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The parts of a GPU's back end: exact sums, networks that sort rows, cells in bricks, how much memory it takes.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "busy_scenes.h"
#include "hooke/backends/gpu/brick_grid.h"
#include "hooke/backends/gpu/cuda_backend.h"
#include "hooke/backends/gpu/fixed_sum.h"
#include "hooke/base/exact_sum.h"
#include "hooke/base/random.h"
#include "hooke/neighbours/row_network.h"
#include "numbers_to_sum.h"
#include "support/gpu_on_host.h"

namespace hooke::test {
namespace {

using gpu::BrickGrid;
using gpu::FixedSum;
using gpu::SumWindow;

// Sums
// -----------------------------------------------------------------------------------------------------------------

template <class Real>
class FixedSums : public testing::Test {};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(FixedSums, Precisions);

TYPED_TEST(FixedSums, AreExact) {
  for (const Kind kind : {Kind::alike, Kind::mixed, Kind::wild, Kind::cancelling, Kind::tiny, Kind::zero}) {
    SCOPED_TRACE(static_cast<int>(kind));
    SumWindow window;
    for (int step = 0; step < 3; ++step) {  // the window follows the largest term
      FixedSum<TypeParam> sum{};
      ExactSum right, found;
      for (std::uint64_t i = 0; i < 3000; ++i) {
        const auto value = number<TypeParam>(kind, 3000 * static_cast<std::uint64_t>(step) + i);
        gpu::add_term(sum, window, value);
        right.add(static_cast<double>(value));
      }
      gpu::add_fixed(sum, window, found);
      EXPECT_EQ(found, right) << "step " << step;
      if (sum.largest != 0) window = SumWindow::around(sum.largest);
    }
  }
}

TYPED_TEST(FixedSums, OfWhatIsNotFiniteAreNaN) {
  for (const TypeParam bad : {std::numeric_limits<TypeParam>::infinity(), -std::numeric_limits<TypeParam>::infinity(),
                              std::numeric_limits<TypeParam>::quiet_NaN()}) {
    FixedSum<TypeParam> sum{};
    gpu::add_term(sum, {}, TypeParam(1));
    gpu::add_term(sum, {}, bad);
    ExactSum found;
    gpu::add_fixed(sum, {}, found);
    EXPECT_TRUE(std::isnan(found.value())) << bad;
  }
}

TEST(FixedSum, SeldomNeedsDigitsOnceItsWindowIsPlaced) {
  SumWindow window;
  for (int step = 0; step < 2; ++step) {
    FixedSum<float> sum{};
    for (std::uint64_t i = 0; i < 3000; ++i) gpu::add_term(sum, window, number<float>(Kind::alike, i));
    const bool any_digit =
        std::any_of(std::begin(sum.digits), std::end(sum.digits), [](auto digit) { return digit != 0; });
    EXPECT_EQ(any_digit, step == 0);
    window = SumWindow::around(sum.largest);
  }
}

// Rows
// -----------------------------------------------------------------------------------------------------------------

template <std::size_t kRows>
void expect_network_sorts() {
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    std::array<std::uint32_t, kRows> row;
    for (std::size_t k = 0; k < kRows; ++k)
      row[k] = static_cast<std::uint32_t>(1000 * uniform4(3, trial, static_cast<std::uint32_t>(k), 0)[0]);
    std::array<std::uint32_t, kRows> right = row;
    std::sort(right.begin(), right.end());
    constexpr auto kPairs = RowNetwork<kRows>::pairs();
    for (std::size_t k = 0; k < RowNetwork<kRows>::count(); ++k) {
      auto &a = row[kPairs.of[k].a], &b = row[kPairs.of[k].b];
      if (b < a) std::swap(a, b);
    }
    ASSERT_EQ(row, right);
  }
}

TEST(RowNetworks, Sort) {
  expect_network_sorts<1>();
  expect_network_sorts<2>();
  expect_network_sorts<13>();
  expect_network_sorts<16>();
  expect_network_sorts<32>();
}

// Cells
// ----------------------------------------------------------------------------------------------------------------

// Every pair of points nearer than the reach is in cells beside each other, at most once.
void expect_all_pairs(const Vec3d& min, const Vec3d& max, const bool (&periodic)[3], double reach,
                      std::uint64_t particles, bool hashed) {
  const BrickGrid grid = BrickGrid::over(min, max, periodic, reach, particles);
  EXPECT_EQ(grid.hashed, hashed);
  std::vector<Vec3d> points;
  const Vec3d length = max - min;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const auto u = uniform4(4, i, 0, 0);
    points.push_back(min + Vec3d{u[0] * length.x, u[1] * length.y, u[2] * length.z});
    if (i % 3 == 0) continue;  // a neighbour of the point before
    const auto v = uniform4(5, i, 0, 0);
    Vec3d near = points.back() + reach * Vec3d{v[0] - 0.5, v[1] - 0.5, v[2] - 0.5};
    for (int axis = 0; axis < 3; ++axis) {
      double& x = component(near, axis);
      if (periodic[axis]) x = wrap_coordinate(x, component(min, axis), component(max, axis));
    }
    points.push_back(near);
  }
  const auto cell_of = [&](const Vec3d& x, int axis) { return grid.index(component(x, axis), axis); };
  for (const Vec3d& a : points) {
    ASSERT_LT(grid.key(cell_of(a, 0), cell_of(a, 1), cell_of(a, 2)), grid.key_end());
    for (const Vec3d& b : points) {
      Vec3d period{0, 0, 0};
      for (int axis = 0; axis < 3; ++axis) component(period, axis) = periodic[axis] ? component(length, axis) : 0;
      const Vec3d apart = nearest_displacement(a, b, period);
      if (!(dot(apart, apart) < reach * reach)) continue;
      for (int axis = 0; axis < 3; ++axis) {
        const BrickGrid::Beside beside = grid.beside(cell_of(a, axis), axis);
        EXPECT_EQ(std::count(beside.of, beside.of + beside.count, cell_of(b, axis)), 1) << "axis " << axis;
      }
    }
  }
}

TEST(BrickGrids, HaveEveryPairInCellsBesideEachOther) {
  expect_all_pairs({-1, 0, 2}, {4, 3, 6}, {false, false, false}, 0.3, 1000, false);
  expect_all_pairs({-1, 0, 2}, {4, 3, 6}, {true, true, true}, 0.3, 1000, false);
  expect_all_pairs({-1, 0, 2}, {4, 3, 6}, {true, false, true}, 1.1, 1000, false);  // three and four cells
  expect_all_pairs({-1, 0, 2}, {4, 3, 6}, {true, true, true}, 2.9, 1000, false);   // one cell
  expect_all_pairs({-1e3, -1e3, -1e3}, {1e3, 1e3, 1e3}, {false, true, false}, 0.3, 1000, true);
}

TEST(BrickGrids, HaveATableThatGoesWithTheParticles) {
  const BrickGrid grid = BrickGrid::over({-1e6, -1e6, -1e6}, {1e6, 1e6, 1e6}, {false, false, false}, 1e-3, 100000);
  EXPECT_TRUE(grid.hashed);
  EXPECT_LE(grid.key_end(), 2U * 100000U + 64U * BrickGrid::kCells);
}

TEST(BrickGrids, TakePointsOutsideOfTheDomainToItsEdge) {
  const BrickGrid grid = BrickGrid::over({0, 0, 0}, {1, 1, 1}, {false, false, false}, 0.1, 1000);
  EXPECT_EQ(grid.index(-5, 0), 0U);
  EXPECT_EQ(grid.index(1e30, 0), grid.axes[0].cells - 1);
}

// Memory
// ---------------------------------------------------------------------------------------------------------------

// What --device cuda reckons with before it takes a scene.
TEST(GpuMemory, IsLessThanWhatIsReckonedAParticle) {
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
      SCOPED_TRACE(testing::PrintToString(precision) + ", " + testing::PrintToString(integrator));
      Scene scene = open_scene();
      scene.precision = precision;
      scene.integrator = integrator;
      const ParticleSet pool = lattice(scene, {32, 32, 32}, {-2, -2, -2}, 0.98, 0, 1);  // each touches six others
      const auto use = std::make_shared<gpu::HostDevice::Use>();
      Simulation simulation = *Simulation::create(scene, pool, make_gpu_on_host(precision, 1, gpu::ItemOrder::up, use),
                                                  {.allow_unstable_step = true});
      ASSERT_TRUE(advance(simulation, 3));
      const auto bytes = static_cast<double>(use->bytes) / static_cast<double>(pool.size());
      RecordProperty("bytes", std::to_string(bytes));
      EXPECT_LE(bytes, static_cast<double>(cuda_bytes_per_particle(precision, integrator)));
      if (precision == Precision::single_precision && integrator == Integrator::symplectic_euler) {
        EXPECT_LE(bytes, 200.0);
      }
    }
  }
}

TEST(GpuMemory, IsNotAskedForInSteadySteps) {
  Scene scene = open_scene();
  scene.precision = Precision::single_precision;
  scene.gravity = {0, 0, 0};
  const ParticleSet pool = lattice(scene, {16, 16, 16}, {-2, -2, -2}, 0.98, 0, 1);
  const auto use = std::make_shared<gpu::HostDevice::Use>();
  Simulation simulation =
      *Simulation::create(scene, pool, make_gpu_on_host(Precision::single_precision, 1, gpu::ItemOrder::up, use),
                          {.allow_unstable_step = true});
  ASSERT_TRUE(advance(simulation, 30));
  const std::size_t before = use->allocations;
  ASSERT_TRUE(advance(simulation, 100));
  EXPECT_EQ(use->allocations, before);
}

TEST(GpuMemory, ThatIsTooLittleIsAnErrorAtTheStart) {
  Scene scene = open_scene();
  scene.precision = Precision::single_precision;
  const ParticleSet pool = lattice(scene, {16, 16, 16}, {-2, -2, -2}, 0.98, 0, 1);
  const auto use = std::make_shared<gpu::HostDevice::Use>();
  use->most_bytes = 100'000;
  const auto simulation =
      Simulation::create(scene, pool, make_gpu_on_host(Precision::single_precision, 1, gpu::ItemOrder::up, use),
                         {.allow_unstable_step = true});
  ASSERT_FALSE(simulation);
  EXPECT_NE(simulation.error().text().find("4096 particles do not fit into memory (the host's stand-in for a GPU"),
            std::string::npos)
      << simulation.error().text();
}

// Steps in a row
// ---------------------------------------------------------------------------------------------------------------

TEST(GpuSteps, ManyInARowAreWaitedForOnce) {
  Scene scene = open_scene();
  scene.precision = Precision::single_precision;
  scene.gravity = {0, 0, 0};
  const ParticleSet pool = lattice(scene, {8, 8, 8}, {-2, -2, -2}, 0.98, 0, 1);
  const auto use = std::make_shared<gpu::HostDevice::Use>();
  Simulation simulation =
      *Simulation::create(scene, pool, make_gpu_on_host(Precision::single_precision, 1, gpu::ItemOrder::up, use),
                          {.allow_unstable_step = true});
  ASSERT_TRUE(advance(simulation, 400));
  const std::size_t before = use->downloads;
  const std::uint64_t lists = simulation.neighbour_statistics().rebuilds;
  ASSERT_TRUE(advance(simulation, 640));
  // A report of each row of steps; what the cells of a new list have found, and how many rows it has.
  EXPECT_LE(use->downloads - before, 10 + 640 / 64 + 10 * (simulation.neighbour_statistics().rebuilds - lists));
}

TEST(GpuFailure, EndsARunWithAnError) {
  Scene scene = open_scene();
  scene.precision = Precision::single_precision;
  const ParticleSet pool = lattice(scene, {6, 6, 6}, {-2, -2, -2}, 0.98, 0, 1);
  const auto use = std::make_shared<gpu::HostDevice::Use>();
  Simulation simulation =
      *Simulation::create(scene, pool, make_gpu_on_host(Precision::single_precision, 1, gpu::ItemOrder::up, use),
                          {.allow_unstable_step = true});
  ASSERT_TRUE(advance(simulation, 3));
  use->launches_left = 5;
  const auto taken = simulation.step(10);
  ASSERT_FALSE(taken);
  EXPECT_EQ(taken.error().kind, Error::Kind::run_failed);
  EXPECT_NE(taken.error().text().find("has failed"), std::string::npos) << taken.error().text();
  EXPECT_FALSE(simulation.step(1)) << "what the device held is lost";
}

}  // namespace
}  // namespace hooke::test
