// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

ParticleSet two() { return pair_on_x(open_scene(), 0.1, {0, 0, 0}, {0, 0, 0}); }

std::string refusal(const Scene& scene, const ParticleSet& particles, const Engine& engine = kReference) {
  const auto simulation = Simulation::create(scene, particles, make_backend(engine));
  if (simulation) return "";
  EXPECT_EQ(simulation.error().kind, Error::Kind::bad_input);
  return simulation.error().text();
}

struct BadParticles {
  const char* says;
  std::function<void(ParticleSet&)> make;
};

const BadParticles kBadParticles[] = {
    {"ids must be unique and ascending", [](ParticleSet& p) { p.id = {2, 2}; }},
    {"ids must be unique and ascending", [](ParticleSet& p) { p.id = {2, 1}; }},
    {"reserved", [](ParticleSet& p) { p.id[1] = ~std::uint64_t{0}; }},
    {"particle 2: material 3 does not exist", [](ParticleSet& p) { p.material[1] = 3; }},
    {"particle 1: position (nan, 0, 0) is not finite", [](ParticleSet& p) { p.position[0].x = NAN; }},
    {"particle 1: velocity (0, inf, 0) is not finite", [](ParticleSet& p) { p.velocity[0].y = INFINITY; }},
    {"particle 2: position (0.9, 0, 101) is outside the domain", [](ParticleSet& p) { p.position[1].z = 101; }},
    {"columns of different length", [](ParticleSet& p) { p.velocity.pop_back(); }},
};

TEST(Create, RefusesBadParticlesAndNamesThem) {
  for (const BadParticles& bad : kBadParticles) {
    ParticleSet particles = two();
    bad.make(particles);
    EXPECT_NE(refusal(open_scene(), particles).find(bad.says), std::string::npos)
        << bad.says << ", but: " << refusal(open_scene(), particles);
  }
}

TEST(Create, RefusesABadSceneWithEveryFinding) {
  Scene scene = open_scene();
  scene.time_step = 0;
  scene.materials[0].mass = 0;
  const std::string text = refusal(scene, two());
  EXPECT_NE(text.find("time.step"), std::string::npos);
  EXPECT_NE(text.find("materials.a.mass"), std::string::npos);
}

TEST(Create, RefusesToHaveNoBackEnd) {
  const auto made = Simulation::create(open_scene(), two(), nullptr);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().text(), "backend: there is none: it is null");
  const auto resumed = Simulation::resume(open_scene(), {}, nullptr);
  ASSERT_FALSE(resumed);
  EXPECT_EQ(resumed.error().text(), "backend: there is none: it is null");
}

TEST(Create, RefusesAnUnstableStepUnlessToldOtherwise) {
  Scene scene = open_scene();
  const StableStep stable = stable_step(scene, two());
  ASSERT_TRUE(std::isfinite(stable.seconds));
  scene.time_step = stable.seconds;
  EXPECT_EQ(refusal(scene, two()), "");
  scene.time_step = 3 * stable.seconds;
  const std::string text = refusal(scene, two());
  EXPECT_NE(text.find("time.step: "), std::string::npos) << text;
  EXPECT_NE(text.find("is 3 times the stable step"), std::string::npos) << text;
  EXPECT_NE(text.find(stable.limit), std::string::npos) << text;
  EXPECT_TRUE(Simulation::create(scene, two(), make_backend(kReference), {.allow_unstable_step = true}));
}

TEST(Create, RefusesABackEndOfLessPrecisionThanAsked) {
  const Scene scene = open_scene();  // double
  EXPECT_NE(refusal(scene, two(), kCpuSingle).find("precision"), std::string::npos);
  Scene single = scene;
  single.precision = Precision::single_precision;
  EXPECT_EQ(refusal(single, two(), kReference), "") << "the reference computes in double whatever is asked";
}

TEST(Create, RefusesWhatSinglePrecisionCannotHold) {
  Scene scene = open_scene();
  scene.precision = Precision::single_precision;
  ParticleSet particles = two();
  particles.velocity[0].x = 1e39;
  EXPECT_NE(refusal(scene, particles, kCpuSingle).find("not finite"), std::string::npos);
}

TEST(Create, StopsCountingBadParticlesAtSomePoint) {
  Scene scene = open_scene();
  ParticleSet particles;
  for (int i = 0; i < 1000; ++i) add(particles, {NAN, 0, 0}, {0, 0, 0});
  const std::string text = refusal(scene, particles);
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 50);
}

class AllEngines : public testing::TestWithParam<Engine> {};

TEST_P(AllEngines, RunNoParticles) {
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
    Scene scene = open_scene();
    scene.integrator = integrator;
    Simulation simulation = simulate(scene, {}, GetParam());
    ASSERT_TRUE(advance(simulation, 10));
    EXPECT_EQ(simulation.particle_count(), 0U);
    EXPECT_EQ(simulation.step_count(), 10);
    EXPECT_EQ(measured(simulation).kinetic_energy, 0);
    const NewParticle added[] = {{0, {0, 0, 0}, {1, 0, 0}}};
    ASSERT_TRUE(simulation.add_particles(added));
    ASSERT_TRUE(advance(simulation, 10));
    EXPECT_NEAR(simulation.positions()[0].x, 10 * scene.time_step, 1e-8);
  }
}

TEST_P(AllEngines, TakeNoStepsWhereNoneAreAsked) {
  Simulation simulation = simulate(open_scene(), two(), GetParam());
  const auto before = simulation.state_hash();
  ASSERT_TRUE(advance(simulation, 0));
  EXPECT_EQ(simulation.state_hash(), before);
  EXPECT_EQ(simulation.step_count(), 0);
}

TEST_P(AllEngines, TellTheTime) {
  Simulation simulation = simulate(open_scene(), two(), GetParam());
  ASSERT_TRUE(advance(simulation, 3));
  ASSERT_TRUE(advance(simulation, 4));
  EXPECT_EQ(simulation.step_count(), 7);
  EXPECT_EQ(simulation.time(), 7 * open_scene().time_step);
}

TEST_P(AllEngines, GiveParticlesByIdWhateverTheirOrder) {
  Scene scene = open_scene();
  const ParticleSet particles = cloud(scene, 500, {-5, -5, -5}, {5, 5, 5}, 1, 3);
  Simulation simulation = simulate(scene, particles, GetParam());
  ASSERT_TRUE(advance(simulation, 5));
  EXPECT_EQ(simulation.particles().id, particles.id);
  EXPECT_EQ(simulation.particles().material, particles.material);
  EXPECT_EQ(simulation.ids().size(), simulation.positions().size());
  EXPECT_EQ(simulation.velocities().data(), simulation.particles().velocity.data());
}

TEST_P(AllEngines, MeasureWhatIsThere) {
  Scene scene = open_scene();
  scene.gravity = {0, -10, 0};
  scene.domain.min = {-0.25, -20, -20};
  scene.domain.boundary[0] = Boundary::spring;
  Simulation simulation = simulate(scene, pair_on_x(scene, 0.25, {1, 2, 0}, {-1, 0, 0}), GetParam());
  const Measurements m = measured(simulation);
  EXPECT_EQ(m.particles, 2U);
  EXPECT_EQ(m.contacts, 1U);
  EXPECT_EQ(m.wall_contacts, 1U);
  EXPECT_EQ(m.kinetic_energy, 3);
  EXPECT_EQ(m.potential_energy, 0);
  EXPECT_EQ(m.elastic_energy, 0.5 * 1000 * 0.25 * 0.25);
  EXPECT_EQ(m.wall_elastic_energy, 0.5 * 1000 * 0.25 * 0.25);
  EXPECT_EQ(m.momentum, (Vec3d{0, 2, 0}));
  EXPECT_EQ(m.centre_of_mass, (Vec3d{0.375, 0, 0}));
  EXPECT_DOUBLE_EQ(m.momentum_scale, std::sqrt(5.0) + 1);
  EXPECT_DOUBLE_EQ(m.max_speed, std::sqrt(5.0));
  EXPECT_EQ(m.max_pair_overlap_ratio, 0.25);
  EXPECT_EQ(m.max_overlap_ratio, 0.5) << "with the wall, of the radius";
  EXPECT_EQ(m.mean_overlap_ratio, 0.25);
  EXPECT_EQ(m.min, (Vec3d{0, 0, 0}));
  EXPECT_EQ(m.max, (Vec3d{0.75, 0, 0}));
  EXPECT_EQ(m.wall_force, (Vec3d{250 - 3, -(2 + 3) * 2, 0}));
  EXPECT_EQ(simulation.initial_energy(), 3 + 0.5 * 1000 * 0.25 * 0.25);
  EXPECT_EQ(simulation.initial_momentum(), (Vec3d{0, 2, 0}));
}

TEST_P(AllEngines, HashWhatMatters) {
  const auto hash = [](const ParticleSet& particles, std::int64_t steps = 0) {
    Scene scene = open_scene();
    Simulation simulation = simulate(scene, particles, GetParam());
    EXPECT_TRUE(advance(simulation, steps));
    return simulation.state_hash();
  };
  ParticleSet still = pair_on_x(open_scene(), -1, {0, 0, 0}, {0, 0, 0});
  const auto original = hash(still);
  EXPECT_EQ(hash(still), original);
  EXPECT_NE(hash(still, 1), original) << "the clock";
  ParticleSet changed = still;
  changed.id[1] = 7;
  EXPECT_NE(hash(changed), original) << "ids";
  changed = still;
  changed.position[0].z = -0.0;
  EXPECT_NE(hash(changed), original) << "every bit of a position, the sign of zero too";
  changed = still;
  changed.velocity[1].x = 1e-30;
  EXPECT_NE(hash(changed), original);
  changed = still;
  std::swap(changed.position[0], changed.position[1]);
  EXPECT_NE(hash(changed), original) << "which particle is where";
}

INSTANTIATE_TEST_SUITE_P(Engines, AllEngines, testing::Values(kReference, kCpuDouble, kCpuSingle),
                         [](const auto& instance) { return instance.param.name(); });

TEST(Restore, RefusesAStateThatCannotBe) {
  Simulation simulation = simulate(open_scene(), two(), kReference);
  ASSERT_TRUE(advance(simulation, 3));
  const SimulationState good = simulation.state();
  const auto refused = [&](const std::function<void(SimulationState&)>& change) {
    SimulationState state = good;
    change(state);
    const auto restored = simulation.restore(std::move(state));
    return !restored && restored.error().kind == Error::Kind::bad_input;
  };
  EXPECT_TRUE(refused([](SimulationState& s) { s.step = -1; }));
  EXPECT_TRUE(refused([](SimulationState& s) { s.next_id = 2; }));
  EXPECT_TRUE(refused([](SimulationState& s) { s.particles.position[0].y = NAN; }));
  EXPECT_TRUE(refused([](SimulationState& s) { s.particles.material[0] = 9; }));
  EXPECT_TRUE(refused([](SimulationState& s) { s.particles.velocity.pop_back(); }));
  EXPECT_EQ(simulation.step_count(), 3) << "a refused state changes nothing";
  EXPECT_TRUE(simulation.restore(good));
}

TEST(Restore, NeedsAccelerationsUnderVelocityVerlet) {
  Scene scene = open_scene();
  scene.integrator = Integrator::velocity_verlet;
  Simulation simulation = simulate(scene, two(), kReference);
  SimulationState state = simulation.state();
  EXPECT_EQ(state.particles.acceleration.size(), 2U);
  state.particles.acceleration.clear();
  EXPECT_FALSE(simulation.restore(state));
}

}  // namespace
}  // namespace hooke::test
