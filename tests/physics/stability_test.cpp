// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The largest stable step of a pile, found by running a face-centred cubic block with the slightest touch.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "hooke/physics/stability.h"
#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

constexpr int kCells = 2;  // along each axis; the fastest mode alternates within one cell
constexpr double kOverlap = 1e-3;

Scene fcc_scene(const ContactCoefficients<double>& contact) {
  Scene scene = open_scene();
  scene.materials[0].contact = contact;
  const double edge = std::sqrt(2.0) * (1 - kOverlap);
  scene.domain.min = {0, 0, 0};
  scene.domain.max = kCells * edge * Vec3d{1, 1, 1};
  scene.domain.boundary = {Boundary::periodic, Boundary::periodic, Boundary::periodic};
  return scene;
}

ParticleSet fcc_block(const Scene& scene) {
  const double half = component(scene.domain.max, 0) / (2 * kCells);
  ParticleSet particles;
  for (int z = 0; z < 2 * kCells; ++z) {
    for (int y = 0; y < 2 * kCells; ++y) {
      for (int x = 0; x < 2 * kCells; ++x) {
        if ((x + y + z) % 2 == 0) add(particles, half * Vec3d{x + 0.5, y + 0.5, z + 0.5}, {0, 0, 0});
      }
    }
  }
  return particles;
}

// The growth of a displacement of 1e-10 m in `steps` of `dt`.
double growth(const ContactCoefficients<double>& contact, double dt, int steps = 80) {
  constexpr double kStart = 1e-10;
  Scene scene = fcc_scene(contact);
  scene.time_step = dt;
  ParticleSet particles = fcc_block(scene);
  const ParticleSet at_rest = particles;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const auto u = random4(1, i);
    particles.position[i] += kStart * Vec3d{2 * u[0] - 1, 2 * u[1] - 1, 2 * u[2] - 1};
    particles.velocity[i] = (kStart / dt) * Vec3d{2 * u[1] - 1, 2 * u[2] - 1, 2 * u[3] - 1};
  }
  Simulation simulation = simulate(scene, particles, kReference);
  EXPECT_EQ(measured(simulation).contacts, 6 * particles.size()) << "twelve neighbours each";
  if (!advance(simulation, steps)) return INFINITY;
  double furthest = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vec3d moved = simulation.positions()[i] - at_rest.position[i];
    furthest = std::max(furthest, std::sqrt(dot(moved, moved)));
  }
  return furthest / kStart;
}

// The block is compressed by 0.1 %, which lowers its eigenvalues by as little.
constexpr double kNear = 0.02;
constexpr int kManySteps = 300;  // a mode of dashpots grows by 4 % a step there

TEST(FccPile, SpringsHaveTheEigenvalueEightKOverM) {
  const ContactCoefficients<double> springs{1000, 0, 0};
  const double critical = critical_step(8 * 1000, 0);
  EXPECT_LT(growth(springs, (1 - kNear) * critical), 100);
  EXPECT_GT(growth(springs, (1 + kNear) * critical), 1e5);
}

TEST(FccPile, DashpotsHaveTheEigenvalueSixteenCOverM) {
  const ContactCoefficients<double> dashpots{0, 0, 10};
  const double critical = critical_step(0, 16 * 10);
  EXPECT_LT(growth(dashpots, (1 - kNear) * critical, kManySteps), 100);
  EXPECT_GT(growth(dashpots, (1 + kNear) * critical, kManySteps), 1e4);
}

TEST(FccPile, BothTogetherObeyTheCombinedBound) {
  const ContactCoefficients<double> both{1000, 0, 10};
  // The two largest eigenvalues belong to the same mode of the fcc lattice.
  const double critical = critical_step(8 * 1000, 16 * 10);
  EXPECT_LT(growth(both, (1 - kNear) * critical, kManySteps), 100);
  EXPECT_GT(growth(both, (1 + kNear) * critical, kManySteps), 1e4);
}

TEST(StableStep, IsOnTheSafeSideOfAnFccPile) {
  for (const ContactCoefficients<double>& c :
       {ContactCoefficients<double>{1000, 0, 0}, {0, 0, 10}, {1000, 5, 10}, {0, 3, 0}, {1000, 0.1, 0.1}}) {
    const double stable = stable_step(fcc_scene(c)).seconds;
    EXPECT_LT(stable, critical_step(8 * c.stiffness, 16 * (c.shear + c.damping)));
    EXPECT_LT(growth(c, stable), 100);
  }
}

TEST(StableStep, NamesThePairThatLimits) {
  Scene scene = open_scene();
  scene.materials = {{"soft", 0.5, 1, {10, 0, 0}, 0, ""}, {"hard", 0.5, 1, {1e6, 0, 0}, 0, ""}};
  EXPECT_EQ(stable_step(scene).limit, "stiffness of hard - hard");
  EXPECT_DOUBLE_EQ(stable_step(scene).seconds, critical_step(kPileSpringFactor * 1e6 / effective_mass(1, 1), 0));
  scene.contacts = {{0, 1, {1e8, 0, 0}}};
  EXPECT_EQ(stable_step(scene).limit, "stiffness of soft - hard");
  scene.contacts = {{0, ContactEntry::kWall, {1e9, 0, 0}}};
  EXPECT_EQ(stable_step(scene).limit, "stiffness and damping of soft - wall");
  scene.contacts = {};
  scene.materials[1].contact = {0, 1000, 1000};
  EXPECT_EQ(stable_step(scene).limit, "shear and damping of hard - hard");
}

// A chain: its fastest mode moves neighbours against each other, omega^2 = 4 k/m, gamma = 4 c/m, except at its ends.
TEST(StableStep, IsThatOfAChainOfSprings) {
  constexpr int kLinks = 60;
  for (const double damping : {0.0, 3.0, 400.0}) {
    Scene scene = open_scene();
    scene.materials[0].contact = {0, 0, 0};
    ParticleSet particles;
    auto structure = std::make_shared<Structure>();
    for (std::uint64_t i = 1; i <= kLinks + 1; ++i) {
      // A small displacement in that mode.
      add(particles, {1.5 * static_cast<double>(i) + (i % 2 == 0 ? 1e-6 : -1e-6), 0, 0}, {0, 0, 0});
      if (i > 1) structure->springs.push_back({i - 1, i, 1.5, 1000, damping});
    }
    structure->pinned = {1};
    scene.structure = structure;
    const StableStep stable = stable_step(scene, particles);
    EXPECT_DOUBLE_EQ(stable.seconds, critical_step(4 * 1000, 4 * damping));
    const char* which = damping == 0 ? "stiffness" : damping == 3 ? "stiffness" : "damping";
    EXPECT_EQ(stable.limit, std::string(which) + " of the springs around particle 2 (" + scene.materials[0].name + ")");
    for (const bool above : {false, true}) {
      scene.time_step = (above ? 1.02 : 0.98) * stable.seconds;
      Simulation s = simulate(scene, particles, kReference);
      (void)s.step(600);
      double fastest = 0;
      for (const Vec3d& v : s.velocities()) fastest = std::max(fastest, std::abs(v.x));
      if (above) {
        EXPECT_GT(fastest, 1);
      } else {
        EXPECT_LT(fastest, 1e-2);
      }
    }
  }
}

TEST(StableStep, NamesTheGroupsOfSprings) {
  Scene scene = open_scene();
  scene.materials[0].contact = {0, 0, 0};
  ParticleSet particles;
  for (int i = 0; i < 4; ++i) add(particles, {1.5 * i, 0, 0}, {0, 0, 0});
  auto structure = std::make_shared<Structure>();
  structure->springs.push_back({1, 2, 1.5, 100, 0});
  structure->springs.push_back({2, 3, 1.5, 1000, 0});
  structure->springs.push_back({3, 4, 1.5, 100, 0});
  structure->groups = {{"bodies[0]", 1}, {"springs[0]", 2}, {"springs[1]", 3}};
  scene.structure = structure;
  const std::string whose = ", " + scene.materials[0].name + ")";
  EXPECT_EQ(stable_step(scene, particles).limit,
            "stiffness of the springs around particle 2 (bodies[0] and springs[0]" + whose);
  structure->springs.stiffness[2] = 5000;
  EXPECT_EQ(stable_step(scene, particles).limit,
            "stiffness of the springs around particle 3 (springs[0] and springs[1]" + whose);
  structure->springs.stiffness[1] = 0;
  structure->pinned = {3};
  EXPECT_EQ(stable_step(scene, particles).limit, "stiffness of the springs around particle 4 (springs[1]" + whose);
}

TEST(StableStep, IsThatOfDrag) {
  Scene scene = open_scene();
  scene.materials[0].contact = {0, 0, 0};
  scene.materials[0].drag = 50;
  EXPECT_DOUBLE_EQ(stable_step(scene).seconds, 2.0 / 50);
  EXPECT_EQ(stable_step(scene).limit, "drag of " + scene.materials[0].name);
}

// Drag of the medium and of fields brake together. A particle's speed grows above the step that stable_step() gives,
// and the limit's name lists every cause of it.
TEST(StableStep, CountsWhatFieldsBrake) {
  Scene scene = open_scene();
  scene.materials[0].contact = {0, 0, 0};
  scene.materials[0].drag = 1;
  scene.materials[0].mass = 2;
  const std::string name = scene.materials[0].name;
  Wind wind;
  scene.fields = {{wind, {}, {}}};
  EXPECT_DOUBLE_EQ(stable_step(scene).seconds, 2.0 * 2 / 1) << "the material's own drag, against the wind";
  EXPECT_EQ(stable_step(scene).limit, "drag of " + name);
  wind.drag = 30;
  scene.fields = {{UniformPush{{1, 0, 0}}, {}, {}}, {wind, {}, {}}};
  EXPECT_DOUBLE_EQ(stable_step(scene).seconds, 2.0 * 2 / 31);
  EXPECT_EQ(stable_step(scene).limit, "drag of the wind fields[1] on " + name);
  scene.fields.push_back({PushToward{{0, 0, 0}, 0, 0, 0.1}, {}, {}});
  EXPECT_DOUBLE_EQ(stable_step(scene).seconds, 2.0 * 2 / 51);
  EXPECT_EQ(stable_step(scene).limit, "drag of the wind fields[1] and time of the push fields[2] on " + name);

  ParticleSet one;
  add(one, {3, 0, 0}, {0.1, 0, 0});
  for (const double part : {0.98, 1.02}) {
    scene.time_step = part * stable_step(scene).seconds;
    Simulation s = simulate(scene, one, kReference);
    (void)s.step(200);
    const double speed = std::sqrt(dot(s.velocities()[0], s.velocities()[0]));
    EXPECT_EQ(speed > 5, part > 1) << speed;
  }
}

TEST(StableStep, NamesTheClothAndTheWindOnIt) {
  Scene scene = open_scene();
  scene.materials[0].contact = {0, 0, 0};
  ParticleSet corners;
  for (const Vec3d& x : {Vec3d{0, 0, 0}, Vec3d{2, 0, 0}, Vec3d{0, 0, 2}}) add(corners, x, {0, 0, 0});
  auto structure = std::make_shared<Structure>();
  structure->surfaces = {{"linen", {1, 2, 3}, {0, 1, 2}}};
  structure->springs.push_back({1, 2, 2, 100, 0});
  structure->groups = {{"cloths[0]", 1}};
  scene.structure = structure;
  const std::string name = scene.materials[0].name;
  EXPECT_EQ(stable_step(scene, corners).limit, "stiffness of the springs around particle 1 (cloths[0], " + name + ")");
  Wind wind;
  wind.area_drag = 300;  // on 2 m^2, a third of it for each corner
  scene.fields = {{wind, {}, {}}};
  EXPECT_DOUBLE_EQ(stable_step(scene, corners).seconds, 2 / 200.0);
  EXPECT_EQ(stable_step(scene, corners).limit, "area_drag of the wind fields[0] on cloths[0]");
  for (const double part : {0.98, 1.02}) {
    scene.time_step = part * 2 / 200.0;
    ParticleSet moved = corners;
    for (Vec3d& v : moved.velocity) v = {0, 1, 0};
    Simulation s = simulate(scene, moved, kReference);
    (void)s.step(100);
    EXPECT_EQ(std::abs(s.velocities()[0].y) > 10, part > 1) << s.velocities()[0].y;
  }
}

TEST(StableStep, IsInfiniteWhereNothingOscillates) {
  Scene scene = open_scene();
  scene.materials[0].contact = {0, 0, 0};
  EXPECT_EQ(stable_step(scene).seconds, INFINITY);
  scene.materials.clear();
  EXPECT_EQ(stable_step(scene).seconds, INFINITY);
}

}  // namespace
}  // namespace hooke::test
