// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Ranks that start with particles which come a slice at a time.

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "busy_scenes.h"
#include "support/ranks.h"
#include "support/small_slices.h"

namespace hooke::test {
namespace {

// Runs look(what create_in_slices() or resume_in_slices() gives) on rank 0, while the others follow.
template <class Start, class Look>
void start_on_ranks(int ranks, const Scene& scene, const Start& start, const Look& look,
                    const Engine& engine = kCpuDouble) {
  run_ranks(ranks, [&](std::shared_ptr<Communicator> communicator) {
    if (communicator->rank() > 0) return Simulation::follow(scene, make_backend(engine), std::move(communicator));
    Expected<Simulation> simulation = start(std::move(communicator));
    look(simulation);
  });
}

auto creating(const Scene& scene, std::shared_ptr<const ParticleSlices> slices, const Engine& engine = kCpuDouble) {
  return [&scene, slices, engine](std::shared_ptr<Communicator> communicator) {
    return Simulation::create_in_slices(scene, slices, make_backend(engine),
                                        {.allow_unstable_step = true, .communicator = std::move(communicator)});
  };
}

auto resuming(const Scene& scene, const SimulationState& saved, std::shared_ptr<const ParticleSlices> slices,
              const Engine& engine = kCpuDouble) {
  SimulationState rest = saved;
  rest.particles = {};
  return [&scene, rest, slices, engine](std::shared_ptr<Communicator> communicator) {
    return Simulation::resume_in_slices(scene, rest, slices, make_backend(engine), std::move(communicator));
  };
}

class SlicesOfBusyScenes : public BusyScenes {};

TEST_P(SlicesOfBusyScenes, StartTheSameRunOnRanks) {
  const Engine own = engine(1);
  scene_.precision = own.precision;
  Simulation one = simulate(scene_, particles_, own);
  ASSERT_TRUE(advance(one, 60));
  const SimulationState saved = one.state();
  ASSERT_TRUE(advance(one, 40));
  const std::pair<int, std::size_t> cases[] = {{1, 7}, {2, 64}, {3, 7}, {5, 1000}};
  for (const auto& [ranks, rows] : cases) {
    SCOPED_TRACE(testing::Message() << ranks << " ranks, slices of " << rows);
    start_on_ranks(
        ranks, scene_, creating(scene_, std::make_shared<SmallSlices>(particles_, rows), own),
        [&](Expected<Simulation>& many) {
          ASSERT_TRUE(many) << many.error().text();
          ASSERT_TRUE(advance(*many, 100));
          expect_same_bits(one, *many);
        },
        own);
    start_on_ranks(
        ranks, scene_, resuming(scene_, saved, std::make_shared<SmallSlices>(saved.particles, rows), own),
        [&](Expected<Simulation>& many) {
          ASSERT_TRUE(many) << many.error().text();
          ASSERT_TRUE(advance(*many, 40));
          expect_same_bits(one, *many);
        },
        own);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, SlicesOfBusyScenes, all_busy_kinds(),
                         [](const auto& instance) { return instance.param.name(); });

// Ids with gaps: the ranks know all of them.
TEST(Slices, MayMissIds) {
  const Scene scene = open_scene();
  const ParticleSet all = lattice(scene, {9, 8, 7}, {-4, -4, -4}, 0.98, 0.05, 1);
  ParticleSet some;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i % 5 == 1 || (i > 100 && i < 130)) continue;
    some.id.push_back(3 * (all.id[i] / 50) + all.id[i]);
    some.material.push_back(all.material[i]);
    some.position.push_back(all.position[i]);
    some.velocity.push_back(all.velocity[i]);
  }
  Simulation one = simulate(scene, some, kCpuDouble);
  ASSERT_TRUE(advance(one, 50));
  for (const int ranks : {2, 4}) {
    start_on_ranks(ranks, scene, creating(scene, std::make_shared<SmallSlices>(some, 11)),
                   [&](Expected<Simulation>& many) {
                     ASSERT_TRUE(many) << many.error().text();
                     ASSERT_TRUE(advance(*many, 50));
                     expect_same_bits(one, *many);
                   });
  }
}

TEST(Slices, MayBeNone) {
  const Scene scene = open_scene();
  const ParticleSet nobody;
  Simulation one = simulate(scene, nobody, kCpuDouble);
  start_on_ranks(3, scene, creating(scene, std::make_shared<SmallSlices>(nobody, 5)), [&](Expected<Simulation>& many) {
    ASSERT_TRUE(many) << many.error().text();
    EXPECT_EQ(many->state_hash(), one.state_hash());
  });
}

// The findings are those of the whole set, wherever slices end.
TEST(Slices, AreRefusedLikeTheWholeSet) {
  Scene scene = open_scene();
  scene.domain.boundary = {Boundary::spring, Boundary::spring, Boundary::spring};
  const ParticleSet good = lattice(scene, {5, 5, 5}, {-2, -2, -2}, 0.98, 0.01, 1);
  std::vector<ParticleSet> faulty(5, good);
  faulty[0].id[63] = faulty[0].id[62];
  faulty[1].material[17] = 99;
  for (std::size_t i = 10; i < 60; ++i) faulty[2].position[i].y = 1e9 + static_cast<double>(i);
  faulty[2].id[100] = 1;
  faulty[3].velocity[124].x = HUGE_VAL;
  faulty[4].id[124] = ~std::uint64_t{0};
  for (const ParticleSet& particles : faulty) {
    const auto whole = Simulation::create(scene, particles, make_backend(kCpuDouble), {.allow_unstable_step = true});
    ASSERT_FALSE(whole);
    SimulationState state;
    state.particles = particles;
    state.next_id = 50;
    const auto resumed = Simulation::resume(scene, state, make_backend(kCpuDouble));
    ASSERT_FALSE(resumed);
    for (const std::size_t rows : {7U, 63U, 1000U}) {
      const auto slices = std::make_shared<SmallSlices>(particles, rows);
      start_on_ranks(2, scene, creating(scene, slices), [&](const Expected<Simulation>& many) {
        ASSERT_FALSE(many);
        EXPECT_EQ(many.error().text(), whole.error().text());
      });
      start_on_ranks(2, scene, resuming(scene, state, slices), [&](const Expected<Simulation>& many) {
        ASSERT_FALSE(many);
        EXPECT_EQ(many.error().text(), resumed.error().text());
      });
    }
  }
}

TEST(Slices, WithoutAccelerationsDontResumeVelocityVerlet) {
  Scene scene = open_scene();
  scene.integrator = Integrator::velocity_verlet;
  SimulationState state;
  state.particles = lattice(scene, {3, 3, 3}, {-2, -2, -2}, 0.98, 0.01, 1);
  state.next_id = 100;
  const auto whole = Simulation::resume(scene, state, make_backend(kCpuDouble));
  ASSERT_FALSE(whole);
  start_on_ranks(2, scene, resuming(scene, state, std::make_shared<SmallSlices>(state.particles, 10)),
                 [&](const Expected<Simulation>& many) {
                   ASSERT_FALSE(many);
                   EXPECT_EQ(many.error().text(), whole.error().text());
                 });
}

// Whichever visit fails, all ranks end with the start, and rank 0 knows why.
TEST(Slices, ThatFailEndTheStartOnAllRanks) {
  const Scene scene = open_scene();
  const ParticleSet particles = lattice(scene, {5, 5, 5}, {-2, -2, -2}, 0.98, 0.01, 1);
  SimulationState state;
  state.next_id = 1000;
  const auto good = std::make_shared<SmallSlices>(particles, 20);
  start_on_ranks(2, scene, creating(scene, good), [](const Expected<Simulation>& many) { ASSERT_TRUE(many); });
  ASSERT_GE(good->visits(), 3);
  for (const int ranks : {1, 2, 3}) {
    for (int failing = 1; failing <= (ranks == 1 ? 1 : good->visits()); ++failing) {
      SCOPED_TRACE(testing::Message() << ranks << " ranks, visit " << failing);
      const auto expect_failure = [](const Expected<Simulation>& many) {
        ASSERT_FALSE(many);
        EXPECT_EQ(many.error().kind, Error::Kind::io);
        EXPECT_EQ(many.error().text(), "slices: can't be read");
      };
      start_on_ranks(ranks, scene, creating(scene, std::make_shared<SmallSlices>(particles, 20, failing)),
                     expect_failure);
      start_on_ranks(ranks, scene, resuming(scene, state, std::make_shared<SmallSlices>(particles, 20, failing)),
                     expect_failure);
    }
  }
}

}  // namespace
}  // namespace hooke::test
