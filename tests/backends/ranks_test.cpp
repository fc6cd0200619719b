// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Scenes computed by several ranks, which are threads here: their bits, their errors, what is saved and refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "busy_scenes.h"
#include "hooke/base/random.h"
#include "hooke/core/emitters.h"
#include "hooke/core/springs.h"
#include "support/ranks.h"

namespace hooke::test {
namespace {

class RanksOfBusyScenes : public BusyScenes {};

TEST_P(RanksOfBusyScenes, HaveTheSameBits) {
  Simulation one = simulate(scene_, particles_, engine(1));
  ASSERT_TRUE(advance(one, 150));
  for (const int ranks : {2, 3, 5, 8}) {
    SCOPED_TRACE(ranks);
    Engine checked = engine(ranks == 3 ? 2 : 1);
    checked.check_list = true;
    on_ranks(ranks, scene_, particles_, checked, [&](Simulation& many) {
      ASSERT_TRUE(advance(many, 70));
      ASSERT_TRUE(advance(many, 80));
      EXPECT_EQ(many.neighbour_statistics().missed_contacts, 0U);
      expect_same_bits(one, many);
    });
  }
}

// A state of any number of ranks goes on on any other.
TEST_P(RanksOfBusyScenes, GoOnFromASavedState) {
  Simulation one = simulate(scene_, particles_, engine(1));
  ASSERT_TRUE(advance(one, 120));
  SimulationState saved;
  on_ranks(3, scene_, particles_, engine(1), [&](Simulation& three) {
    ASSERT_TRUE(advance(three, 60));
    saved = three.state();
  });
  for (const int ranks : {1, 2, 4}) {
    SCOPED_TRACE(ranks);
    resume_on_ranks(ranks, scene_, saved, engine(1), [&](Simulation& resumed) {
      ASSERT_TRUE(advance(resumed, 60));
      expect_same_bits(one, resumed);
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, RanksOfBusyScenes, all_busy_kinds(),
                         [](const auto& instance) { return instance.param.name(); });

TEST(Ranks, RefuseWhatTheyCantComputeYet) {
  const Scene scene = open_scene();
  const ParticleSet particles = lattice(scene, {4, 4, 4}, {-2, -2, -2}, 1.2, 0.01, 1);
  run_ranks(2, [&](std::shared_ptr<Communicator> communicator) {
    if (communicator->rank() > 0) return Simulation::follow(scene, make_backend(kGpuDouble), std::move(communicator));
    const auto refused =
        Simulation::create(scene, particles, make_backend(kGpuDouble), {.communicator = std::move(communicator)});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().text().find("can't compute on several ranks yet"), std::string::npos)
        << refused.error().text();
  });
  on_ranks(2, scene, particles, kCpuDouble, [](Simulation& simulation) {
    EXPECT_FALSE(simulation.apply_impulse(1, {1, 0, 0}));
    EXPECT_FALSE(simulation.remove_particles(std::vector<std::uint64_t>{1}));
    EXPECT_TRUE(advance(simulation, 3)) << "it goes on";
  });
}

TEST(Ranks, ReportTheErrorOfOneRank) {
  Scene scene = open_scene();
  scene.domain.boundary[1] = Boundary::spring;
  scene.gravity = {0, -2e4, 0};  // they fall on the floor too fast
  const ParticleSet particles = lattice(scene, {6, 6, 6}, {-8, -2, -8}, 2.5, 0.1, 1);
  Simulation one = simulate(scene, particles, kCpuDouble);
  const auto alone = one.step(1000);
  ASSERT_FALSE(alone);
  for (const int ranks : {2, 4}) {
    on_ranks(ranks, scene, particles, kCpuDouble, [&](Simulation& many) {
      const auto together = many.step(1000);
      ASSERT_FALSE(together);
      EXPECT_EQ(together.error().text(), alone.error().text());
      EXPECT_EQ(many.step_count(), one.step_count());
      EXPECT_FALSE(many.step(1)) << "it takes no more steps";
    });
  }
}

// More ranks than particles, nobody at all, everybody in one place, one large among many small.
TEST(Ranks, MayHaveNothingToDo) {
  Scene scene = open_scene();
  scene.gravity = {0, -9.8, 0};
  ParticleSet three;
  for (int k = 0; k < 3; ++k) add(three, {1.1 * k, 0.3, 0}, {0.5 - k, 0, 0.1});
  for (const ParticleSet& particles : {ParticleSet{}, three}) {
    Simulation one = simulate(scene, particles, kCpuDouble);
    ASSERT_TRUE(advance(one, 400));
    on_ranks(8, scene, particles, kCpuDouble, [&](Simulation& many) {
      ASSERT_TRUE(advance(many, 400));
      EXPECT_EQ(many.state_hash(), one.state_hash());
      EXPECT_EQ(many.ledger(), one.ledger());
    });
  }
}

// A gas of which one half of space is three times as dear as the other: a rank's clock tells it, and the ranks' boxes
// follow until all take as long. Where clocks stand still they have as many particles each.
TEST(Ranks, ShareOutTheTimeThatWorkTakes) {
  Scene scene = open_scene();
  scene.domain = {{-24, -8, -8}, {24, 8, 8}, {Boundary::spring, Boundary::spring, Boundary::spring}};
  ParticleSet gas = lattice(scene, {40, 13, 13}, {-23.4, -7.2, -7.2}, 1.2, 0.05, 1);
  for (std::size_t i = 0; i < gas.size(); ++i) {
    const auto u = uniform4(11, i, 0);
    gas.velocity[i] = {20 * (u[0] - 0.5), 20 * (u[1] - 0.5), 20 * (u[2] - 0.5)};
  }
  const BoxCost dear_below_zero = [](const Box3d& box) {
    double volume[2];  // of the box, in units of half of all: x below 0, above
    for (int side = 0; side < 2; ++side) {
      const Vec3d low = {std::max(box.min.x, side == 0 ? -24.0 : 0.0), std::max(box.min.y, -8.0),
                         std::max(box.min.z, -8.0)};
      const Vec3d high = {std::min(box.max.x, side == 0 ? 0.0 : 24.0), std::min(box.max.y, 8.0),
                          std::min(box.max.z, 8.0)};
      volume[side] = std::max(0.0, high.x - low.x) * (high.y - low.y) * (high.z - low.z) / 6144;
    }
    return 1e-3 * (3 * volume[0] + volume[1]);
  };
  Simulation one = simulate(scene, gas, kCpuDouble);
  ASSERT_TRUE(advance(one, 600));
  for (const bool timed : {false, true}) {
    SCOPED_TRACE(timed ? "timed" : "counted");
    on_ranks(
        2, scene, gas, kCpuDouble,
        [&](Simulation& two) {
          ASSERT_TRUE(advance(two, 300));
          (void)two.rank_costs();
          ASSERT_TRUE(advance(two, 300));
          const RankCosts costs = two.rank_costs();
          EXPECT_GT(costs.exchanges, 10U);
          EXPECT_NEAR(costs.particles.most / costs.particles.sum, timed ? 2.0 / 3 : 0.5, 0.05);
          EXPECT_NEAR(costs.uneven_particles, timed ? 4.0 / 3 : 1, 0.08);
          EXPECT_LT(costs.uneven_time, 1.1);
          expect_same_bits(one, two);
        },
        timed ? dear_below_zero : BoxCost());
  }
  // Sums of five times are not the same on all, which add in different orders: they cut at the same steps all the same.
  on_ranks(
      5, scene, gas, kCpuDouble,
      [&](Simulation& five) {
        ASSERT_TRUE(advance(five, 600));
        const RankCosts costs = five.rank_costs();
        EXPECT_GE(costs.cuts, 2U);  // one of them at the start
        EXPECT_LT(costs.uneven_time, 1.2);
        EXPECT_EQ(five.state_hash(), one.state_hash());
      },
      dear_below_zero);
}

// open_scene() with a material "spark" whose particles touch no others, and so many births of them a second.
Scene scene_with_sparks(double rate) {
  Scene scene = open_scene();
  scene.materials.push_back(scene.materials[0]);
  scene.materials.back().name = "spark";
  scene.materials.back().interacts = false;
  if (rate == 0) return scene;
  Emitter source;
  source.material = 1;
  source.shape = BoxShape{{-3, 4, -3}, {3, 6, 3}};
  source.rate = rate;
  source.speed = {1, 2};
  source.spread = 90;
  scene.emitters = {source};
  return scene;
}

std::shared_ptr<Structure> ties(const ParticleSet& particles, std::size_t apart, const Spring& like) {
  const auto structure = std::make_shared<Structure>();
  for (std::size_t i = 0; i + apart < particles.size(); i += 3) {
    Spring spring = like;
    spring.a = particles.id[i];
    spring.b = particles.id[i + apart];
    structure->springs.push_back(spring);
  }
  return structure;
}

void expect_same_bits_on_ranks(const Scene& scene, const ParticleSet& particles, std::int64_t steps) {
  Simulation one = simulate(scene, particles, kCpuDouble);
  ASSERT_TRUE(advance(one, steps / 2));
  const double energy = measured(one).spring_energy;
  ASSERT_TRUE(advance(one, steps - steps / 2));
  for (const int ranks : {2, 3, 5}) {
    SCOPED_TRACE(ranks);
    on_ranks(ranks, scene, particles, kCpuDouble, [&](Simulation& many) {
      ASSERT_TRUE(advance(many, steps / 2));
      EXPECT_EQ(measured(many).spring_energy, energy);
      ASSERT_TRUE(advance(many, steps - steps / 2));
      expect_same_bits(one, many);
      EXPECT_EQ(one.broken_springs(), many.broken_springs());
    });
  }
}

// Some of which are born on the way.
TEST(Ranks, ComputeForcesBetweenParticlesThatTouchNoOthers) {
  Scene scene = scene_with_sparks(300);
  scene.attraction.emplace();
  scene.attraction->constant = 2;
  scene.attraction->softening = 0.3;
  scene.time_step = 0.01;
  const ParticleSet particles = cloud(scene, 300, {-6, -6, -6}, {6, 6, 6}, 1, 5);
  scene.structure = ties(particles, 30, {0, 0, 2, 20, 0.5});
  expect_same_bits_on_ranks(scene, particles, 100);
}

// So many that all others have to move to make room.
TEST(Ranks, HaveRoomForManyBirths) {
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
    Scene scene = scene_with_sparks(200'000);
    scene.integrator = integrator;
    scene.gravity = {0, -10, 0};
    ParticleSet particles = lattice(scene, {12, 8, 12}, {-6, -6, -6}, 1.01, 0.05, 1);
    particles.material.assign(particles.size(), 0);
    for (Vec3d& v : particles.velocity) v = {3, 0, 1};
    expect_same_bits_on_ranks(scene, particles, 40);
  }
}

TEST(Ranks, HaveSpringsWhileSparksComeAndGo) {
  Scene scene = scene_with_sparks(8000);
  scene.emitters[0].life = Range{0.004, 0.02};
  scene.emitters[0].respawn = true;
  ParticleSet particles = lattice(scene, {8, 8, 8}, {-4, -6, -4}, 1.2, 0.05, 1);
  particles.material.assign(particles.size(), 0);
  for (std::size_t i = 0; i < particles.size(); ++i)
    particles.velocity[i] = {static_cast<double>(i % 5) - 2, 0, static_cast<double>(i % 7) - 3};
  scene.structure = ties(particles, 1, {0, 0, 1.2, 900, 1, 0.02, SpringMode::both, false});
  expect_same_bits_on_ranks(scene, particles, 80);
}

TEST(Ranks, TearSpringsBetweenParticlesThatTouchNoOthers) {
  Scene scene = scene_with_sparks(0);
  ParticleSet particles = lattice(scene, {6, 6, 6}, {-4, -4, -4}, 1.2, 0.05, 1);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    particles.material[i] = i % 5 == 0 ? 0 : 1;
    particles.velocity[i] = {9 * (static_cast<double>(i % 5) - 2), 0, 5};
  }
  scene.structure = ties(particles, 1, {0, 0, 1.2, 900, 1, 0.05, SpringMode::both, false});
  expect_same_bits_on_ranks(scene, particles, 80);
  Simulation one = simulate(scene, particles, kCpuDouble);
  ASSERT_TRUE(advance(one, 80));
  EXPECT_GT(one.broken_springs().size(), 20U);
}

// Two balls from two ranks meet where a third rank has sparks alone.
TEST(Ranks, SeeWhatMeetsInTheBoxOfAnother) {
  const Scene scene = scene_with_sparks(0);
  ParticleSet particles;
  const auto block = [&](double x, std::uint16_t material) {
    for (int k = 0; k < 1000; ++k)
      add(particles, {x + 1.2 * (k / 100), 1.2 * (k / 10 % 10) - 5.4, 1.2 * (k % 10) - 5.4}, {0, 0, 0}, material);
  };
  block(-40, 0);
  block(-5.4, 1);
  block(28, 0);
  add(particles, {-20, 0.1, 0}, {200, 0, 0});
  add(particles, {20, -0.1, 0}, {-200, 0, 0});
  expect_same_bits_on_ranks(scene, particles, 110);
  Simulation one = simulate(scene, particles, kCpuDouble);
  const double before = measured(one).kinetic_energy;
  ASSERT_TRUE(advance(one, 110));
  EXPECT_LT(measured(one).kinetic_energy, 0.99 * before) << "they have met";
}

// Two blocks fly at each other through the box of a rank that has sparks alone: the lists of both stay good, and only
// the slack says that ghosts are due. Within a block, particles stray from its motion by a part of the skin.
TEST(Ranks, SeeBlocksThatFlyAtEachOther) {
  const Scene scene = scene_with_sparks(0);
  for (const double stray : {0.0, 6.0}) {
    for (int k = 0; k < 10; ++k) {
      const double gap = 3.5 + 0.05 * k;  // of centres: contacts begin at 1
      SCOPED_TRACE(testing::Message() << gap << " m, " << stray << " m/s");
      ParticleSet particles;
      for (const double side : {-1.0, 0.0, 1.0}) {
        for (int i = 0; i < 512; ++i) {
          const double along = side == 0 ? 0.1 * (i / 64) - 0.35 : side * (0.5 * gap + 1.3 * (i / 64));
          const double strayed = side == 0 ? 0 : stray * (random4(9, particles.size())[0] - 0.5);
          add(particles, {along, 1.3 * (i / 8 % 8), 1.3 * (i % 8)}, {-20 * side + strayed, 0, 0}, side == 0 ? 1 : 0);
        }
      }
      Simulation one = simulate(scene, particles, kCpuDouble);
      ASSERT_TRUE(advance(one, 90));
      ASSERT_GT(measured(one).contacts, 50U);
      on_ranks(3, scene, particles, kCpuDouble, [&](Simulation& many) {
        ASSERT_TRUE(advance(many, 90));
        EXPECT_EQ(many.state_hash(), one.state_hash());
        EXPECT_EQ(many.ledger(), one.ledger());
      });
    }
  }
}

// What all have in common makes no list stale: 3 m here, six slacks. One particle strays from the others as they fly,
// so that there are outliers, which are looked at by the motion that is expected of all.
TEST(Ranks, KeepTheirListWhileAllFlyTogether) {
  const Scene scene = open_scene();
  ParticleSet particles;
  for (int i = 0; i < 512; ++i) add(particles, {1.3 * (i / 64), 1.3 * (i / 8 % 8), 1.3 * (i % 8)}, {50, 0, 0});
  particles.velocity[7 * 64 + 7 * 8 + 7] = {50, 0, 10};  // out of a corner, 0.6 m
  Simulation one = simulate(scene, particles, kCpuDouble);
  ASSERT_TRUE(advance(one, 60));
  ASSERT_EQ(one.neighbour_statistics().rebuilds, 1U);
  for (const int ranks : {2, 4}) {
    on_ranks(ranks, scene, particles, kCpuDouble, [&](Simulation& many) {
      ASSERT_TRUE(advance(many, 60));
      EXPECT_EQ(many.neighbour_statistics().rebuilds, 1U);
      EXPECT_EQ(many.state_hash(), one.state_hash());
    });
  }
}

// Two blocks on two ranks fly at each other by almost a slack, and one particle in front of each flies ahead of its
// block by almost half a skin. The lists of both stay good, all the while, and the two particles come to touch: each
// rank must know them both from the start. One is `ahead` (m) of the face between the ranks, the other at it; contacts
// begin at 1.
TEST(Ranks, KnowWhoComesToTouchWithinASkinAndASlack) {
  const Scene scene = open_scene();
  constexpr double kSkin = 0.25, kSlack = 0.5;  // of a first list, m
  constexpr double kBlock = 20, kAhead = 4;  // m/s
  constexpr std::int64_t kSteps = 24;  // of 0.02 m each and, for those in front, 0.004 m more
  static_assert(kSteps * 0.001 * kBlock < 0.99 * kSlack && kSteps * 0.001 * kAhead < 0.49 * kSkin);
  for (const double ahead : {1.45, 1.505, 1.52, 1.54, 1.56}) {
    SCOPED_TRACE(ahead);
    ParticleSet particles;
    add(particles, {-ahead, 0, 0}, {kAhead, 0, 0});
    add(particles, {0, 0, 0}, {-kBlock - kAhead, 0, 0});
    for (int i = 0; i < 1000; ++i) {
      const Vec3d at{4 + 1.3 * (i / 100), 1.3 * (i / 10 % 10 - 4.5), 1.3 * (i % 10 - 4.5)};
      add(particles, {-at.x, at.y, at.z}, {0, 0, 0});
      add(particles, at, {-kBlock, 0, 0});
    }
    Simulation one = simulate(scene, particles, kCpuDouble);
    ASSERT_TRUE(advance(one, kSteps));
    ASSERT_EQ(measured(one).contacts, 1U);
    on_ranks(2, scene, particles, kCpuDouble, [&](Simulation& many) {
      ASSERT_TRUE(advance(many, kSteps));
      EXPECT_EQ(many.neighbour_statistics().rebuilds, 1U) << "the first list was good for all steps";
      EXPECT_EQ(many.state_hash(), one.state_hash());
      EXPECT_EQ(many.ledger(), one.ledger());
    });
  }
}

TEST(Ranks, ShareAMixtureOfVeryDifferentRadii) {
  Scene scene = open_scene();
  scene.gravity = {0, -9.8, 0};
  scene.domain.min = {-4, -4, -4};
  scene.domain.max = {4, 6, 4};
  scene.domain.boundary = {Boundary::spring, Boundary::spring, Boundary::periodic};
  scene.materials = {{"dust", 0.1, 0.1, {600, 0.2, 0.8}, 0, ""}, {"ball", 1.0, 50, {60000, 2, 8}, 0, ""}};
  ParticleSet particles = lattice(scene, {20, 20, 20}, {-3.9, -3.9, -3.9}, 0.21, 0.02, 3);
  particles.material.assign(particles.size(), 0);
  add(particles, {0, 4.5, 0}, {1, -9, 2}, 1);
  Simulation one = simulate(scene, particles, kCpuSingle);
  ASSERT_TRUE(advance(one, 300));
  Engine checked = kCpuSingle;
  checked.check_list = true;
  for (const int ranks : {2, 4, 7}) {
    SCOPED_TRACE(ranks);
    on_ranks(ranks, scene, particles, checked, [&](Simulation& many) {
      ASSERT_TRUE(advance(many, 300));
      EXPECT_EQ(many.neighbour_statistics().missed_contacts, 0U);
      expect_same_bits(one, many);
    });
  }
}

#if HOOKE_ASSERTIONS
TEST(RanksDeathTest, ThatDisagreeSaySo) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(run_ranks(2,
                         [](std::shared_ptr<Communicator> communicator) {
                           const int rank = communicator->rank();
                           Ranks ranks(std::move(communicator));
                           std::uint64_t one = 1;
                           rank == 0 ? ranks.sum(one) : (void)ranks.first({});
                         }),
               "is at line [0-9]+ of ranks.cpp.* while another rank is elsewhere");
}
#endif

}  // namespace
}  // namespace hooke::test
