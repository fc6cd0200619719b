// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "hooke/base/exact_sum.h"
#include "hooke/base/random.h"
#include "hooke/comm/mpi/mpi_communicator.h"
#include "hooke/comm/mpi/own_cores.h"
#include "hooke/core/shared_particles.h"

// Every rank is a program of its own that runs all these tests, in the same order.
namespace hooke::test {
namespace {

constexpr std::size_t kLargestMessage = 1000;  // so that tests send pieces

std::shared_ptr<Communicator>& joined() {
  static std::shared_ptr<Communicator> ranks;
  return ranks;
}
Communicator& all() { return *joined(); }
int here() { return all().rank(); }
int size() { return all().size(); }

std::vector<std::byte> bytes(std::size_t count, int seed) {
  std::vector<std::byte> made(count);
  for (std::size_t i = 0; i < count; ++i) made[i] = static_cast<std::byte>(i * 7 + static_cast<std::size_t>(seed));
  return made;
}

// combine() -----------------------------------------------------------------------------------------------------------

TEST(Combine, SumsTheSameOnAllRanks) {
  std::vector<std::uint64_t> counts(100);
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = i + static_cast<std::size_t>(here());
  all().combine(counts.data(), counts.size(), sizeof counts[0], [](const void* item, void* sum) {
    *static_cast<std::uint64_t*>(sum) += *static_cast<const std::uint64_t*>(item);
  });
  const auto ranks = static_cast<std::size_t>(size());
  for (std::size_t i = 0; i < counts.size(); ++i) EXPECT_EQ(counts[i], i * ranks + ranks * (ranks - 1) / 2);
}

// Sums larger than any message between ranks, of many numbers of very different size: the bits of one rank's.
TEST(Combine, ExactSumsHaveTheBitsOfOneRank) {
  struct Sums {
    ExactSum sum[3];
    std::uint64_t most;
  };
  constexpr int kTerms = 1000, kSums = 25;
  const auto term = [](int i, int k) { return std::sin(i * 12.9 + k) * std::pow(10.0, (i + k) % 40 - 20); };
  std::vector<Sums> sums(kSums), expected(kSums);
  for (int i = 0; i < kTerms; ++i) {
    for (std::size_t k = 0; k < kSums; ++k) {
      for (int j = 0; j < 3; ++j) {
        const double value = term(i, static_cast<int>(k) + j);
        expected[k].sum[j].add(value);
        if (i % size() == here()) sums[k].sum[j].add(value);
      }
    }
  }
  for (Sums& s : sums) s.most = static_cast<std::uint64_t>(here());
  all().combine(sums.data(), sums.size(), sizeof(Sums), [](const void* item, void* sum) {
    const Sums& from = *static_cast<const Sums*>(item);
    Sums& to = *static_cast<Sums*>(sum);
    for (int j = 0; j < 3; ++j) to.sum[j].add(from.sum[j]);
    to.most = std::max(to.most, from.most);
  });
  for (std::size_t k = 0; k < kSums; ++k) {
    for (int j = 0; j < 3; ++j) EXPECT_EQ(sums[k].sum[j].value(), expected[k].sum[j].value());
    EXPECT_EQ(sums[k].most, static_cast<std::uint64_t>(size() - 1));
  }
}

TEST(Combine, NothingIsNothing) {
  all().combine(nullptr, 0, 8, [](const void*, void*) { FAIL(); });
}

// broadcast() ---------------------------------------------------------------------------------------------------------

TEST(Broadcast, EveryoneGetsWhatRank0Has) {
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, kLargestMessage, 5 * kLargestMessage + 3}) {
    std::vector<std::byte> data = here() == 0 ? bytes(length, 5) : bytes(17, here());
    all().broadcast(data);
    EXPECT_EQ(data, bytes(length, 5));
  }
}

TEST(Broadcast, ComesSoonManyTimes) {
  for (int i = 0; i < 200; ++i) {
    std::vector<std::byte> data = here() == 0 ? bytes(9, i) : std::vector<std::byte>();
    all().broadcast(data);
    ASSERT_EQ(data, bytes(9, i));
  }
}

// exchange() ----------------------------------------------------------------------------------------------------------

TEST(Exchange, NobodySendsAnything) { EXPECT_TRUE(all().exchange({}).empty()); }

TEST(Exchange, ToItself) {
  const std::vector<Parcel> in = all().exchange({{here(), bytes(3000, here())}});
  ASSERT_EQ(in.size(), 1U);
  EXPECT_EQ(in[0].rank, here());
  EXPECT_TRUE(in[0].bytes == bytes(3000, here()));
}

TEST(Exchange, AllToRank0AndBack) {
  std::vector<Parcel> out;
  if (here() > 0) out.push_back({0, bytes(static_cast<std::size_t>(here()), here())});
  std::vector<Parcel> in = all().exchange(std::move(out));
  ASSERT_EQ(in.size(), here() == 0 ? static_cast<std::size_t>(size() - 1) : 0U);
  for (std::size_t k = 0; k < in.size(); ++k) {
    const int from = static_cast<int>(k) + 1;
    EXPECT_EQ(in[k].rank, from);
    EXPECT_EQ(in[k].bytes, bytes(k + 1, from));
  }
  in = all().exchange(std::move(in));
  ASSERT_EQ(in.size(), here() > 0 ? 1U : 0U);
  if (here() > 0) {
    EXPECT_EQ(in[0].bytes, bytes(static_cast<std::size_t>(here()), here()));
  }
}

// What rank a sends to rank b, so that each can tell what it gets: nothing to some, many pieces to others.
std::size_t length(int from, int to) { return static_cast<std::size_t>((from * 7 + to * 13) % 5) * 1777; }

TEST(Exchange, AllToAllOfAnyLength) {
  for (int turn = 0; turn < 3; ++turn) {
    std::vector<Parcel> out;
    for (int to = size() - 1; to >= 0; --to) out.push_back({to, bytes(length(here(), to), here() + to)});
    std::vector<Parcel> in = all().exchange(std::move(out));
    std::size_t k = 0;
    for (int from = 0; from < size(); ++from) {
      if (length(from, here()) == 0) continue;
      ASSERT_LT(k, in.size());
      EXPECT_EQ(in[k].rank, from);
      EXPECT_EQ(in[k].bytes, bytes(length(from, here()), from + here()));
      ++k;
    }
    EXPECT_EQ(k, in.size());
  }
}

TEST(Exchange, Large) {
  constexpr std::size_t kLarge = 4'000'000;
  const int next = (here() + 1) % size(), last = (here() + size() - 1) % size();
  const std::vector<Parcel> in = all().exchange({{next, bytes(kLarge, here())}});
  ASSERT_EQ(in.size(), 1U);
  EXPECT_EQ(in[0].rank, last);
  EXPECT_TRUE(in[0].bytes == bytes(kLarge, last));
}

// open() --------------------------------------------------------------------------------------------------------------

TEST(Channel, CarriesWhatIsInPlaceAgainAndAgain) {
  std::vector<std::vector<std::byte>> out, in;
  std::vector<Communicator::Route> to, from;
  for (int rank = 0; rank < size(); ++rank) {
    out.emplace_back(length(here(), rank));
    in.emplace_back(length(rank, here()));
  }
  for (int rank = size() - 1; rank >= 0; --rank) {
    to.push_back({rank, out[static_cast<std::size_t>(rank)]});
    from.push_back({rank, in[static_cast<std::size_t>(rank)]});
  }
  const auto channel = all().open(to, from);
  for (int turn = 0; turn < 20; ++turn) {
    for (int rank = 0; rank < size(); ++rank) {
      const std::vector<std::byte> now = bytes(length(here(), rank), here() + turn);
      std::ranges::copy(now, out[static_cast<std::size_t>(rank)].begin());
    }
    channel->exchange();
    for (int rank = 0; rank < size(); ++rank)
      ASSERT_TRUE(in[static_cast<std::size_t>(rank)] == bytes(length(rank, here()), rank + turn));
  }
}

TEST(Channel, OneFollowsAnother) {
  const int next = (here() + 1) % size(), last = (here() + size() - 1) % size();
  for (int turn = 0; turn < 50; ++turn) {
    int mine = here() * 100 + turn, theirs = -1;
    const Communicator::Route to{next, std::as_writable_bytes(std::span(&mine, 1))};
    const Communicator::Route from{last, std::as_writable_bytes(std::span(&theirs, 1))};
    const auto channel = all().open({&to, 1}, {&from, 1});
    channel->exchange();
    ASSERT_EQ(theirs, last * 100 + turn);
  }
}

TEST(Channel, OfNoRoutes) { all().open({}, {})->exchange(); }

// cut() ---------------------------------------------------------------------------------------------------------------

Vec3d random_point(std::uint64_t i) {
  const auto u = uniform4(7, i, 0);
  return {10 * u[0], 4 * u[1] * u[1], 2 * u[2] * u[2] * u[2] - 5};
}

// Every place has one owner: the points, faces, corners, and what is far away.
void expect_tiling(const std::vector<Box3d>& boxes, const std::vector<Vec3d>& points) {
  ASSERT_EQ(boxes.size(), static_cast<std::size_t>(size()));
  const double far = 1e30;
  std::vector<double> at[3];
  for (int axis = 0; axis < 3; ++axis) {
    at[axis] = {-far, 0, far};
    for (const Box3d& box : boxes) {
      for (const double face : {component(box.min, axis), component(box.max, axis)}) {
        ASSERT_FALSE(std::isnan(face));
        if (!std::isfinite(face)) continue;
        at[axis].push_back(face);
        at[axis].push_back(std::nextafter(face, -far));
      }
    }
  }
  Decomposition space;
  space.boxes = boxes;
  const auto owners = [&](const Vec3d& x) {
    int count = 0;
    for (int rank = 0; rank < size(); ++rank) count += space.owns(rank, x) ? 1 : 0;
    return count;
  };
  for (const Vec3d& x : points) ASSERT_EQ(owners(x), 1);
  for (const double x : at[0]) {
    for (const double y : at[1]) {
      for (const double z : at[2]) ASSERT_EQ(owners({x, y, z}), 1) << x << ' ' << y << ' ' << z;
    }
  }
  std::vector<std::byte> of_rank0(sizeof(Box3d) * boxes.size());
  std::memcpy(of_rank0.data(), boxes.data(), of_rank0.size());
  all().broadcast(of_rank0);
  ASSERT_EQ(of_rank0.size(), sizeof(Box3d) * boxes.size());
  EXPECT_EQ(std::memcmp(of_rank0.data(), boxes.data(), of_rank0.size()), 0);
}

std::vector<std::size_t> counts(const std::vector<Box3d>& boxes, const std::vector<Vec3d>& points) {
  Decomposition space;
  space.boxes = boxes;
  std::vector<std::size_t> found(boxes.size());
  for (const Vec3d& x : points) ++found[static_cast<std::size_t>(space.owner(x))];
  return found;
}

std::vector<WeightedPoint> weighted(const std::vector<Vec3d>& points, double weight = 1) {
  std::vector<WeightedPoint> all;
  for (const Vec3d& x : points) all.push_back({x, weight});
  return all;
}

// This rank's part of points that all know.
std::vector<Vec3d> part(const std::vector<Vec3d>& points) {
  std::vector<Vec3d> own;
  for (std::size_t i = static_cast<std::size_t>(here()); i < points.size(); i += static_cast<std::size_t>(size()))
    own.push_back(points[i]);
  return own;
}

std::vector<Vec3d> random_points(std::size_t count) {
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(random_point(i));
  return points;
}

TEST(Cut, BoxesHoldAsManyPointsEach) {
  const std::vector<Vec3d> points = random_points(20'000);
  const std::vector<Box3d> boxes = all().cut(weighted(part(points)));
  expect_tiling(boxes, points);
  for (const std::size_t count : counts(boxes, points))
    EXPECT_NEAR(static_cast<double>(count), 20'000.0 / size(), 20'000.0 / size() * 0.02);
}

TEST(Cut, OfPointsThatOneRankHas) {
  const std::vector<Vec3d> points = random_points(20'000);
  const std::vector<Box3d> boxes = all().cut(weighted(here() == 0 ? points : std::vector<Vec3d>()));
  expect_tiling(boxes, points);
  for (const std::size_t count : counts(boxes, points))
    EXPECT_NEAR(static_cast<double>(count), 20'000.0 / size(), 20'000.0 / size() * 0.02);
}

// Half of the points weigh four times as much as the others, and lie elsewhere.
TEST(Cut, BoxesHoldAsMuchWeightEach) {
  const std::vector<Vec3d> light = random_points(20'000);
  std::vector<Vec3d> heavy = light;
  for (Vec3d& x : heavy) x.x += 20;
  std::vector<WeightedPoint> own = weighted(part(light), 0.5);
  for (const WeightedPoint& p : weighted(part(heavy), 2)) own.push_back(p);
  const std::vector<Box3d> boxes = all().cut(own);
  expect_tiling(boxes, light);
  const std::vector<std::size_t> heavies = counts(boxes, heavy), lights = counts(boxes, light);
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const double weight = 2.0 * static_cast<double>(heavies[k]) + 0.5 * static_cast<double>(lights[k]);
    EXPECT_NEAR(weight, 50'000.0 / size(), 50'000.0 / size() * 0.02);
  }
}

TEST(Cut, OuterFacesAreAtInfinity) {
  const std::vector<Vec3d> points = random_points(500);
  const std::vector<Box3d> boxes = all().cut(weighted(part(points)));
  Box3d around = Box3d::none();
  for (const Box3d& box : boxes) around.add(box);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(around, (Box3d{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}}));
}

TEST(Cut, OfALattice) {
  std::vector<Vec3d> points;
  for (int i = 0; i < 8000; ++i) points.push_back({0.1 * (i % 20), 0.1 * (i / 20 % 20), 0.1 * (i / 400)});
  const std::vector<Box3d> boxes = all().cut(weighted(here() == 0 ? points : std::vector<Vec3d>()));
  expect_tiling(boxes, points);
  for (const std::size_t count : counts(boxes, points))
    EXPECT_NEAR(static_cast<double>(count), 8000.0 / size(), 400);  // a layer
}

TEST(Cut, WithoutPoints) { expect_tiling(all().cut({}), random_points(1000)); }

TEST(Cut, OfOnePoint) {
  std::vector<WeightedPoint> points;
  if (here() == size() - 1) points.push_back({{1, 2, 3}});
  expect_tiling(all().cut(points), random_points(1000));
}

// Also fewer than ranks, and several in one place.
TEST(Cut, OfFewPoints) {
  for (std::uint64_t turn = 0; turn < 100; ++turn) {
    std::vector<Vec3d> points;
    for (std::uint64_t i = 0; i <= turn % 20; ++i) {
      const auto u = uniform4(3, 100 * turn + i, 0);
      points.push_back({std::floor(4 * u[0]), std::floor(3 * u[1]), std::floor(2 * u[2])});
    }
    expect_tiling(all().cut(weighted(part(points))), points);
  }
}

TEST(Cut, OfPointsInOnePlace) {
  const std::vector<Vec3d> points(1000, Vec3d{1, 2, 3});
  expect_tiling(all().cut(weighted(part(points))), random_points(1000));
}

TEST(Cut, OfPointsOnALine) {
  std::vector<Vec3d> points;
  for (int i = 0; i < 1000; ++i) points.push_back({0, 0.5 * i, 0});
  const std::vector<Box3d> boxes = all().cut(weighted(part(points)));
  expect_tiling(boxes, points);
  for (const std::size_t count : counts(boxes, points)) EXPECT_NEAR(static_cast<double>(count), 1000.0 / size(), 2);
}

TEST(Cut, LeavesOutWhatIsNotFinite) {
  std::vector<Vec3d> points = random_points(1000);
  const std::vector<Vec3d> good = points;
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  points[3].x = nan;
  points[4].y = infinity;
  points[5].z = -infinity;
  expect_tiling(all().cut(weighted(part(points))), good);
}

TEST(Cut, ManyTimes) {
  for (std::uint64_t turn = 0; turn < 20; ++turn) {
    std::vector<Vec3d> points;
    for (std::size_t i = 0; i < 50 * turn; ++i) points.push_back(random_point(turn * 1000 + i));
    expect_tiling(all().cut(weighted(part(points))), points);
  }
}

// The node
// -------------------------------------------------------------------------------------------------------------

TEST(Cores, AtLeastOneForEachRank) { EXPECT_GE(own_cores(), 1); }

// mpirun starts all of these ranks on this machine.
TEST(Cores, AllRanksAreOnThisNode) { EXPECT_EQ(ranks_on_this_node(), all().size()); }

}  // namespace

// Joins the ranks that mpirun has started; they are left before the program ends.
bool join() {
  const char* const launched = std::getenv("OMPI_COMM_WORLD_SIZE");
  auto ranks = join_ranks(launched != nullptr ? std::atoi(launched) : 1, {.largest_message = kLargestMessage});
  if (!ranks) {
    std::fprintf(stderr, "%s\n", ranks.error().text().c_str());
    return false;
  }
  joined() = std::move(*ranks);
  return true;
}
int rank() { return here(); }
void leave() { joined() = nullptr; }

}  // namespace hooke::test

int main(int argc, char** argv) {
  if (!hooke::test::join()) return 1;
  if (hooke::test::rank() > 0) GTEST_FLAG_SET(brief, true);  // one rank is enough to say what goes well
  testing::InitGoogleTest(&argc, argv);
  const int status = RUN_ALL_TESTS();
  hooke::test::leave();
  return status;
}
