// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Runs that go wrong stop, and say where and why.

#include <gtest/gtest.h>

#include <cmath>

#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

class Failures : public testing::TestWithParam<std::tuple<Engine, Integrator>> {
 protected:
  Failures() {
    scene_ = open_scene();
    scene_.integrator = std::get<1>(GetParam());
  }
  Simulation start(const ParticleSet& particles) const { return simulate(scene_, particles, std::get<0>(GetParam())); }

  // The error that stops `simulation` within `steps`.
  static Error stopped(Simulation& simulation, std::int64_t steps) {
    const auto taken = simulation.step(steps);
    EXPECT_FALSE(taken);
    if (taken) return {Error::Kind::bad_input, {{"", "it did not stop"}}};
    EXPECT_EQ(taken.error().kind, Error::Kind::run_failed);
    EXPECT_EQ(taken.error().findings.size(), 1U);
    return taken.error();
  }
  static void expect_words(const Error& error, std::initializer_list<const char*> words) {
    for (const char* word : words)
      EXPECT_NE(error.text().find(word), std::string::npos) << word << " in: " << error.text();
  }

  Scene scene_;
};

// 80 times the stable step: the block blows up.
TEST_P(Failures, NameStepParticlesAndCause) {
  scene_.time_step = 1;
  scene_.domain.min = {-1, -1, -1};
  scene_.domain.max = {5, 5, 5};
  scene_.domain.boundary = {Boundary::spring, Boundary::spring, Boundary::spring};
  const ParticleSet particles = lattice(scene_, {4, 4, 4}, {0, 0, 0}, 0.95, 0.01, 1);
  Simulation simulation = start(particles);
  const Error error = stopped(simulation, 1000);
  expect_words(error, {"step ", "particle", "time.step 1 s is ", "times the stable step", "a - a"});
  const std::int64_t stopped_at = simulation.step_count();
  EXPECT_LT(stopped_at, 1000);
  const auto again = simulation.step(5);
  ASSERT_FALSE(again) << "it takes no more steps";
  EXPECT_EQ(again.error().text(), error.text());
  EXPECT_EQ(simulation.step_count(), stopped_at);
  EXPECT_EQ(simulation.particles().size(), simulation.ids().size());
}

TEST_P(Failures, CanBeGoneBackFrom) {
  const ParticleSet particles = pair_on_x(scene_, -0.05, {0, 0, 0}, {0, 0, 0});
  Simulation simulation = start(particles);
  ASSERT_TRUE(advance(simulation, 2));
  const SimulationState good = simulation.state();
  ASSERT_TRUE(simulation.apply_impulse(1, {600, 0, 0}));
  stopped(simulation, 5);
  ASSERT_TRUE(simulation.restore(good));
  EXPECT_TRUE(advance(simulation, 20));
}

// While touching, the pair approaches by more than the smaller radius in one step: no contact law resolves that.
TEST_P(Failures, ReportAPairThatApproachesTooFast) {
  scene_.materials.push_back({"b", 0.1, 1, {1000, 2, 3}, 0, ""});
  ParticleSet particles;
  add(particles, {5, 5, 5}, {0, 0, 0});
  add(particles, {0, 0, 0}, {0, 0, 0}, 0);
  add(particles, {0.595, 0, 0}, {-101, 0, 0}, 1);  // 0.101 m in a step, radius 0.1
  Simulation simulation = start(particles);
  const Error error = stopped(simulation, 1);
  expect_words(error, {"step 0", "particles 2 and 3 approach at", "more than the smaller radius", "time.step 0.001 s"});
  EXPECT_EQ(simulation.step_count(), 0);
}

TEST_P(Failures, LeaveApproachesJustBelowTheLimitAlone) {
  scene_.materials.push_back({"b", 0.1, 1, {1000, 2, 3}, 0, ""});
  ParticleSet particles;
  add(particles, {0, 0, 0}, {0, 0, 0}, 0);
  add(particles, {0.595, 0, 0}, {-99, 0, 0}, 1);
  add(particles, {0, 9, 0}, {0, 0, 0}, 0);
  add(particles, {0.995, 9, 0}, {-400, 0, 0}, 0);  // four times the smallest radius, but less than this pair's
  Simulation simulation = start(particles);
  EXPECT_TRUE(advance(simulation, 1));
}

TEST_P(Failures, LeaveFastSeparationAlone) {
  const ParticleSet particles = pair_on_x(scene_, 0.01, {-5000, 0, 0}, {5000, 0, 0});
  Simulation simulation = start(particles);
  EXPECT_TRUE(advance(simulation, 1));
}

// Fast enough to come out on the other side without an approach that any step sees: 2.7 radii a step.
TEST_P(Failures, ReportAPairThatHasPassedThroughEachOther) {
  ParticleSet particles;
  add(particles, {0, 9, 0}, {0, 0, 0});
  add(particles, {0.05, 1.1, 0}, {0, -1350, 0});
  add(particles, {0, 0, 0}, {0, 0, 0});
  Simulation simulation = start(particles);
  const Error error = stopped(simulation, 2);
  expect_words(error, {"particles 2 and 3 part at", "they have passed through each other", "time.step 0.001 s"});
}

Collider plate(const Shape& shape, bool hollow = false) {
  Collider made;
  made.name = "plate";
  made.shape = shape;
  made.hollow = hollow;
  return made;
}

// Through a face that both sides touch, and through a solid plate thinner than a step.
TEST_P(Failures, ReportAParticleThatHasPassedThroughACollider) {
  for (const Collider& collider :
       {plate(DiscShape{{0, 0, 0}, {0, 1, 0}, 5}), plate(BoxShape{{-5, -0.01, -5}, {5, 0.01, 5}}),
        plate(BoxShape{{-5, -3, -5}, {5, 0, 5}}, true)}) {
    scene_.colliders = {collider};
    ParticleSet particles;
    add(particles, {0, 9, 0}, {0, 0, 0});
    add(particles, {0, 0.52, 0}, {0, -600, 0});
    Simulation simulation = start(particles);
    const Error error = stopped(simulation, 2);
    expect_words(error, {"particle 2 and collider \"plate\" part at", "it has passed through"});
  }
}

// It starts close behind the plate: no step has brought it there.
TEST_P(Failures, LeaveFastStartsBehindAColliderAlone) {
  scene_.integrator = Integrator::symplectic_euler;
  scene_.colliders = {plate(DiscShape{{0, 0, 0}, {0, 1, 0}, 5})};
  ParticleSet particles;
  add(particles, {0, -0.1, 0}, {0, -600, 0});
  Simulation simulation = start(particles);
  EXPECT_TRUE(advance(simulation, 3));
}

TEST_P(Failures, ReportAParticleThatMeetsAWallTooFast) {
  scene_.domain.boundary[1] = Boundary::spring;
  ParticleSet particles;
  add(particles, {0, 0, 0}, {0, 0, 0});
  add(particles, {5, -99.3, 0}, {0, -501, 0});
  Simulation simulation = start(particles);
  const Error error = stopped(simulation, 2);
  expect_words(error, {"particle 2 approaches a wall at", "more than its radius"});
  EXPECT_EQ(simulation.step_count(), std::get<1>(GetParam()) == Integrator::symplectic_euler ? 1 : 0);
}

TEST_P(Failures, LeaveFreeParticlesOfAnySpeedAlone) {
  scene_.domain.boundary = {Boundary::periodic, Boundary::open, Boundary::open};
  ParticleSet particles;
  for (int i = 0; i < 10; ++i) add(particles, {0, 3.0 * i - 15, 0}, {std::pow(10.0, i), 0, 0});
  Simulation simulation = start(particles);
  ASSERT_TRUE(advance(simulation, 50));
  EXPECT_EQ(simulation.particle_count(), 10U);
  for (const Vec3d& x : simulation.positions()) {
    EXPECT_GE(x.x, scene_.domain.min.x);
    EXPECT_LT(x.x, scene_.domain.max.x);
  }
}

TEST_P(Failures, RemoveFastParticlesThroughOpenFaces) {
  ParticleSet particles;
  add(particles, {0, 0, 0}, {1e15, 0, 0});
  add(particles, {0, 9, 0}, {0, 0, 0});
  Simulation simulation = start(particles);
  ASSERT_TRUE(advance(simulation, 3));
  EXPECT_EQ(simulation.particle_count(), 1U);
}

// Forces overflow: the run stops in the next step at the latest, and names the particle.
TEST_P(Failures, ReportWhatIsNoLongerFinite) {
  scene_.domain.boundary = {Boundary::spring, Boundary::spring, Boundary::spring};
  scene_.materials[0].contact = {1e38, 0, 0};
  scene_.materials[0].mass = 1e-30;
  if (std::get<0>(GetParam()).precision == Precision::double_precision) {
    scene_.materials[0].contact.stiffness = 1e300;
    scene_.materials[0].mass = 1e-300;
  }
  ParticleSet particles;
  add(particles, {0, 50, 0}, {0, 0, 0});
  add(particles, {0, 0, 0}, {0, 0, 0});
  add(particles, {0.5, 0, 0}, {0, 0, 0});
  auto simulation = start(particles);
  const Error error = stopped(simulation, 3);
  expect_words(error, {"particle 2", "stable step"});
  EXPECT_LE(simulation.step_count(), 1);
}

TEST_P(Failures, ReportParticlesLostInSpace) {
  const Engine& engine = std::get<0>(GetParam());
  if (engine.device == "reference") GTEST_SKIP() << "looks at all pairs, so has no grid that could overflow";
  scene_.domain.boundary = {Boundary::spring, Boundary::spring, Boundary::spring};
  ParticleSet particles;
  add(particles, {0, 0, 0}, {0, 0, 0});
  add(particles, {0, 9, 0}, {3e21, 0, 0});
  Simulation simulation = start(particles);
  expect_words(stopped(simulation, 3), {"particle 2"});
}

INSTANTIATE_TEST_SUITE_P(Engines, Failures,
                         testing::Combine(testing::Values(kReference, kCpuDouble, kCpuSingle),
                                          testing::Values(Integrator::symplectic_euler, Integrator::velocity_verlet)),
                         [](const auto& instance) {
                           const bool verlet = std::get<1>(instance.param) == Integrator::velocity_verlet;
                           return std::get<0>(instance.param).name() + (verlet ? "_verlet" : "_euler");
                         });

}  // namespace
}  // namespace hooke::test
