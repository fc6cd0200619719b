// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "timeline.h"

#include <gmock/gmock.h>

#include <cmath>

#include "hooke/run/open_simulation.h"
#include "view_scene.h"

namespace hooke::test {
namespace {

using namespace view;

class Timelines : public ViewTest {
 protected:
  void SetUp() override {
    auto opened = run::open_simulation(options().scene, options().device, {});
    ASSERT_TRUE(opened) << opened.error().text();
    Timeline::Settings settings;
    settings.source = scene_source(options().scene, options().device);
    settings.scene = scene::Json::parse(opened->resolved);
    simulation.emplace(std::move(opened->simulation));
    timeline.emplace(std::move(settings), *simulation);
  }
  void advance(int steps) {
    for (int i = 0; i < steps; ++i) ASSERT_TRUE(timeline->step(*simulation));
  }
  void act(const Action& action) {
    const auto acted = timeline->act(*simulation, action);
    ASSERT_TRUE(acted) << acted.error().text();
  }

  std::optional<Simulation> simulation;
  std::optional<Timeline> timeline;
};

TEST_F(Timelines, LeadACollidersNoFasterThanParticlesCanFollow) {
  act(HoldCollider{"ball", {0, 0, 0}});
  act(Lead{{0, -0.5, 0}});
  Vec3d last = simulation->collider_poses()[0].pivot;
  for (int i = 0; i < 300; ++i) {
    advance(1);
    const ColliderPose& pose = simulation->collider_poses()[0];
    EXPECT_LE(std::abs(pose.pivot.y - last.y), 0.1001 * 0.03) << "a tenth of the smallest radius";
    last = pose.pivot;
  }
  EXPECT_NEAR(last.y, 0.4, 1e-6);
  EXPECT_EQ(timeline->hand().held_collider(), "ball");
  act(LetGo{});
  advance(1);
  EXPECT_EQ(simulation->collider_poses()[0].velocity, (Vec3d{0, 0, 0}));
  EXPECT_NEAR(simulation->collider_poses()[0].pivot.y, 0.4, 1e-6) << "it stays where it is";
}

TEST_F(Timelines, PullParticlesToWhereTheyAreLed) {
  const Vec3d before = simulation->find(1)->position;
  act(HoldParticles{{1}});
  act(Lead{{0, 1, 0}});
  advance(600);
  const Vec3d after = simulation->find(1)->position;
  EXPECT_NEAR(after.y, before.y + 1, 0.01);
  act(LetGo{});
  advance(200);
  EXPECT_LT(simulation->find(1)->position.y, before.y + 0.9) << "it falls again";
}

TEST_F(Timelines, CutSpringsForGood) {
  ASSERT_TRUE(simulation->broken_springs().empty());
  act(CutSprings{{3, 9}});
  EXPECT_EQ(simulation->broken_springs(), (std::vector<std::uint64_t>{3, 9}));
  advance(5);
  act(CutSprings{{4}});
  EXPECT_EQ(simulation->broken_springs(), (std::vector<std::uint64_t>{3, 4, 9}));
  EXPECT_FALSE(timeline->act(*simulation, CutSprings{{4}})) << "there is none to cut";
}

// Half of them, under both integrators. Contacts between their ends may begin: their energy is in the entry, too.
TEST_F(Timelines, BookTheEnergyOfSpringsThatAreCut) {
  std::uint64_t first = 0;
  for (const char* integrator : {"symplectic-euler", "velocity-verlet"}) {
    act(ChangeScene{scene::Json::array({{{"op", "add"}, {"path", "/time/integrator"}, {"value", integrator}}})});
    advance(40);
    const auto energy = [&] {
      const Measurements now = *simulation->measure();
      return now.kinetic_energy + now.potential_energy + now.elastic_energy + now.spring_energy +
             simulation->ledger().springs.broken_energy;
    };
    const auto error = [&] {
      return integration_error(*simulation->measure(), simulation->ledger(), simulation->initial_elastic());
    };
    const double before = energy(), error_before = error(), springs = simulation->measure()->spring_energy;
    const std::uint64_t broken = simulation->ledger().springs.broken;
    const double booked = simulation->ledger().springs.broken_energy;
    CutSprings half;
    for (std::uint64_t k = first++; k < simulation->scene().structure->springs.size(); k += 2)
      half.springs.push_back(k);
    act(half);
    EXPECT_NEAR(energy(), before, 1e-13 * std::abs(before)) << integrator;
    EXPECT_NEAR(error(), error_before, 1e-13 * std::abs(before)) << integrator;
    EXPECT_LT(simulation->measure()->spring_energy, 0.9 * springs);
    EXPECT_GT(simulation->ledger().springs.broken_energy, booked);
    EXPECT_EQ(simulation->ledger().springs.broken - broken, half.springs.size());

    // The work of all causes still adds up to what the particles gain.
    const Ledger ledger = simulation->ledger();
    const double kinetic = simulation->measure()->kinetic_energy;
    advance(40);
    const Ledger later = simulation->ledger();
    double work = 0, throughput = 0;
    for (std::size_t cause = 0; cause < later.work.of.size(); ++cause) {
      work += later.work.of[cause] - ledger.work.of[cause];
      throughput += std::abs(later.work.of[cause] - ledger.work.of[cause]);
    }
    EXPECT_NEAR(work, simulation->measure()->kinetic_energy - kinetic, 1e-4 * throughput) << integrator;
  }
}

TEST_F(Timelines, AddBallsOnlyWhereThereIsRoom) {
  const std::uint64_t before = simulation->particle_count();
  act(AddBall{"red", {1, 0.3, 1}, 0.4, {0, 0, 0}});  // half of it inside of the block
  EXPECT_GT(simulation->particle_count(), before);
  const auto figures = simulation->measure();
  ASSERT_TRUE(figures);
  EXPECT_LT(figures->max_pair_overlap_ratio, 1e-3);
}

TEST_F(Timelines, ScatterAllButWhatSpringsTie) {
  const std::uint64_t before = simulation->particle_count();
  const std::uint64_t tied = simulation->scene().structure->springs.a[0];
  const Vec3d held = simulation->find(tied)->position, loose = simulation->find(1)->position;
  act(Scatter{5});
  EXPECT_EQ(simulation->particle_count(), before);
  EXPECT_EQ(simulation->find(tied)->position, held);
  EXPECT_NE(simulation->find(1)->position, loose);
  advance(20);
}

TEST_F(Timelines, KnowWhenParticlesWereBorn) {
  advance(10);
  act(AddBall{"red", {1, 1.2, 0.4}, 0.1, {0, 0, 0}});
  ASSERT_EQ(timeline->births().size(), 2u);
  EXPECT_DOUBLE_EQ(timeline->births()[1].time, 0.01);
  ASSERT_TRUE(timeline->go_back(*simulation, 5));
  EXPECT_EQ(timeline->births().size(), 1u);
}

TEST(EffectsOfChanges, FollowFromWhereTheyAre) {
  EXPECT_EQ(effect_of("/name"), Effect::nothing);
  EXPECT_EQ(effect_of("/time/end"), Effect::nothing);
  EXPECT_EQ(effect_of("/materials/water/radius"), Effect::at_once);
  EXPECT_EQ(effect_of("/colliders/12/motion/velocity/0"), Effect::at_once);
  EXPECT_EQ(effect_of("/colliders/12/shape/sphere/radius"), Effect::rebuild);
  EXPECT_EQ(effect_of("/time/step"), Effect::rebuild);
  EXPECT_EQ(effect_of("/gravity/1"), Effect::rebuild);
  EXPECT_EQ(effect_of("/particles/0/block/spacing"), Effect::reset);
}

}  // namespace
}  // namespace hooke::test
