// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Attraction together with everything else that acts on particles: the CPU has the reference's bits, for any threads,
// instruction set and restart.

#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "busy_scenes.h"
#include "hooke/backends/cpu/isa.h"
#include "support/engines.h"
#include "support/particles.h"
#include "support/ranks.h"

namespace hooke::test {
namespace {

using Kind = std::tuple<Integrator, Precision, Attraction::Method>;

// Balls of three materials in a box with walls on two axes and open faces on the third. The balls attract and touch
// each other, springs tie some of them, and some leave.
class AttractingBalls : public testing::TestWithParam<Kind> {
 protected:
  Scene scene_ = open_scene();
  ParticleSet particles_;

  AttractingBalls() {
    const auto [integrator, precision, method] = GetParam();
    mix_materials(scene_, 0.25);
    scene_.integrator = integrator;
    scene_.precision = precision;
    scene_.domain.min = {-4, -3, -3};
    scene_.domain.max = {4, 3, 3};
    scene_.domain.boundary = {Boundary::open, Boundary::spring, Boundary::spring};
    scene_.gravity = {0, -1, 0};
    scene_.attraction.emplace();
    scene_.attraction->constant = 0.3;
    scene_.attraction->softening = 0.05;
    scene_.attraction->method = method;
    scene_.time_step = 0.002;
    particles_ = cloud(scene_, 400, {-3.9, -2.4, -2.4}, {3.9, 2.4, 2.4}, 3, 17);
    for (std::uint64_t& id : particles_.id) id += 1000 + (id > 300 ? 2000 : 0);  // ids span several blocks
    const auto structure = std::make_shared<Structure>();
    for (std::size_t i = 0; i + 40 < particles_.size(); i += 40) {
      structure->springs.push_back({particles_.id[i], particles_.id[i + 7], 1, 50, 0.5});
    }
    structure->pinned = {particles_.id[11]};
    scene_.structure = structure;
  }

  Engine engine(int threads, const std::string& isa = "") const {
    return {"cpu", std::get<Precision>(GetParam()), threads, isa, false};
  }
};

TEST_P(AttractingBalls, HaveTheSameBitsEverywhere) {
  Simulation right = simulate(scene_, particles_, engine(1));
  ASSERT_TRUE(advance(right, 60));
  ASSERT_GT(right.ledger().removed, 0U);
  ASSERT_GT(measured(right).contacts, 10U);
  for (const int threads : {2, 3, 8}) {
    Simulation other = simulate(scene_, particles_, engine(threads));
    ASSERT_TRUE(advance(other, 60));
    expect_same_bits(right, other);
  }
  for (const Engine& engine : engines_with_the_same_bits(std::get<Precision>(GetParam()))) {
    if (engine.device == "gpu" && scene_.attraction->method == Attraction::Method::tree) continue;  // it has no tree
    SCOPED_TRACE(engine.name());
    Simulation other = simulate(scene_, particles_, engine);
    ASSERT_TRUE(advance(other, 60));
    expect_same_bits(right, other);
  }
}

TEST_P(AttractingBalls, HaveTheSameBitsOnAnyNumberOfRanks) {
  Simulation one = simulate(scene_, particles_, engine(1));
  ASSERT_TRUE(advance(one, 60));
  for (const int ranks : {2, 5}) {
    SCOPED_TRACE(ranks);
    on_ranks(ranks, scene_, particles_, engine(1), [&](Simulation& many) {
      ASSERT_TRUE(advance(many, 60));
      expect_same_bits(one, many);
    });
  }
}

TEST_P(AttractingBalls, GoOnAfterARestart) {
  Simulation whole = simulate(scene_, particles_, engine(2));
  ASSERT_TRUE(advance(whole, 80));
  Simulation first = simulate(scene_, particles_, engine(1));
  ASSERT_TRUE(advance(first, 40));
  Simulation second = resume(scene_, first.state(), engine(3));
  ASSERT_TRUE(advance(second, 40));
  expect_same_bits(whole, second);
}

INSTANTIATE_TEST_SUITE_P(Kinds, AttractingBalls,
                         testing::Combine(testing::Values(Integrator::symplectic_euler, Integrator::velocity_verlet),
                                          testing::Values(Precision::single_precision, Precision::double_precision),
                                          testing::Values(Attraction::Method::direct, Attraction::Method::tree)));

using ByReference = AttractingBalls;

TEST_P(ByReference, HaveItsBits) {
  Simulation reference = simulate(scene_, particles_, kReference);
  Simulation cpu = simulate(scene_, particles_, kCpuDouble);
  for (int part = 0; part < 3; ++part) {
    ASSERT_TRUE(advance(reference, 15));
    ASSERT_TRUE(advance(cpu, 15));
    EXPECT_EQ(cpu.state_hash(), reference.state_hash());
    EXPECT_EQ(cpu.ledger().work[Cause::attraction], reference.ledger().work[Cause::attraction]);
    EXPECT_EQ(cpu.ledger().impulse[Cause::attraction], reference.ledger().impulse[Cause::attraction]);
    EXPECT_EQ(measured(cpu).attraction_energy, measured(reference).attraction_energy);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ByReference,
                         testing::Combine(testing::Values(Integrator::symplectic_euler, Integrator::velocity_verlet),
                                          testing::Values(Precision::double_precision),
                                          testing::Values(Attraction::Method::direct)));

// Suns, their distances and Newton's constant: numbers for which single precision has no room without scaled units.
TEST(AstronomicalScales, FitIntoSinglePrecision) {
  Scene scene = open_scene();
  scene.precision = Precision::single_precision;
  scene.materials = {{"sun", 7e8, 2e30, {1e15, 0, 0}, 0, ""}};
  scene.domain.min = {-1e13, -1e13, -1e13};
  scene.domain.max = {1e13, 1e13, 1e13};
  scene.attraction.emplace();
  scene.time_step = 1e5;
  ParticleSet particles;
  for (int i = 0; i < 20; ++i) add(particles, {3e11 * i, 1e11 * ((7 * i) % 5), 2e11 * ((3 * i) % 4)}, {0, 0, 0});
  Simulation reference = simulate(scene, particles, kReference);
  Simulation direct = simulate(scene, particles, kCpuSingle);
  scene.attraction->method = Attraction::Method::tree;
  Simulation tree = simulate(scene, particles, kCpuSingle);
  for (Simulation* s : {&reference, &direct, &tree}) ASSERT_TRUE(advance(*s, 20));
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vec3d right = reference.velocities()[i];
    const Vec3d off_direct = direct.velocities()[i] - right, off_tree = tree.velocities()[i] - right;
    const double speed = std::sqrt(dot(right, right));
    EXPECT_GT(speed, 100);
    EXPECT_LT(std::sqrt(dot(off_direct, off_direct)), 1e-5 * speed);
    EXPECT_LT(std::sqrt(dot(off_tree, off_tree)), 1e-2 * speed);
  }
}

TEST(AttractionMethod, IsChosenByNumberAndAccuracyAlone) {
  Attraction attraction;
  EXPECT_FALSE(attracts_by_tree(attraction, 1000));
  EXPECT_TRUE(attracts_by_tree(attraction, 100'000));
  attraction.accuracy = kFinestAccuracy;
  EXPECT_FALSE(attracts_by_tree(attraction, 10'000));
  attraction.method = Attraction::Method::tree;
  EXPECT_TRUE(attracts_by_tree(attraction, 2));
  attraction.method = Attraction::Method::direct;
  EXPECT_FALSE(attracts_by_tree(attraction, 10'000'000));
}

TEST(AttractionOfAScene, IsRefusedWhereItMakesNoSense) {
  Scene scene = open_scene();
  scene.attraction.emplace();
  EXPECT_TRUE(validate(scene).empty());
  scene.attraction->constant = -1;
  scene.attraction->softening = std::nan("");
  scene.attraction->accuracy = 0.5;
  scene.domain.boundary[1] = Boundary::periodic;
  const auto findings = validate(scene);
  ASSERT_EQ(findings.size(), 4U);
  EXPECT_EQ(findings[0].where, "attraction.G");
  EXPECT_EQ(findings[1].where, "attraction.softening");
  EXPECT_EQ(findings[2].where, "attraction.accuracy");
  EXPECT_EQ(findings[3].where, "attraction");
}

}  // namespace
}  // namespace hooke::test
