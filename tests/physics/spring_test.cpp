// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Springs against analytic solutions.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

constexpr double kStiffness = 900, kMass1 = 1, kMass2 = 3, kRest = 4;
constexpr double kEffective = kMass1 * kMass2 / (kMass1 + kMass2);

std::shared_ptr<const Structure> structure_of(const std::vector<Spring>& springs,
                                              std::vector<std::uint64_t> pinned = {}) {
  auto structure = std::make_shared<Structure>();
  for (const Spring& s : springs) structure->springs.push_back(s);
  structure->pinned = std::move(pinned);
  return structure;
}

// Two particles of different mass, at rest, tied by a spring that is stretched by `extension` (m).
struct Pair {
  Scene scene = open_scene();
  ParticleSet particles;

  Pair(double extension, double damping, SpringMode mode, double dt) {
    scene.integrator = Integrator::velocity_verlet;
    scene.time_step = dt;
    scene.materials = {{"a", 0.5, kMass1, {1000, 0, 0}, 0, ""}, {"b", 0.5, kMass2, {1000, 0, 0}, 0, ""}};
    // Not along an axis.
    const Vec3d along{2.0 / 7, 3.0 / 7, 6.0 / 7};
    add(particles, {1, 2, 3}, {0, 0, 0}, 0);
    add(particles, Vec3d{1, 2, 3} + (kRest + extension) * along, {0, 0, 0}, 1);
    Spring s{1, 2, kRest, kStiffness, damping};
    s.mode = mode;
    scene.structure = structure_of({s});
  }
};

double extension_of(const Simulation& s) {
  const Vec3d d = s.positions()[1] - s.positions()[0];
  return std::sqrt(dot(d, d)) - kRest;
}

class SpringModes : public testing::TestWithParam<std::tuple<SpringMode, double>> {};

// e'' = -k/m e - c/m e' while the spring acts, and a steady rate while it doesn't. The spring acts at the start.
TEST_P(SpringModes, FollowTheAnalyticSolution) {
  const auto [mode, damping] = GetParam();
  const double start = mode == SpringMode::compression ? -0.1 : 0.1, dt = 1e-4;
  const double decay = damping / kEffective / 2, omega = std::sqrt(kStiffness / kEffective - decay * decay);
  const auto acting = [&](double t) {
    return start * std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t));
  };
  const auto rate = [&](double t) {
    return -start * std::exp(-decay * t) * (omega + decay * decay / omega) * std::sin(omega * t);
  };
  const double crossing = (M_PI - std::atan(omega / decay)) / omega;  // when the spring first passes its rest length
  const auto expected = [&](double t) {
    if (mode == SpringMode::both || t <= crossing) return acting(t);
    return rate(crossing) * (t - crossing);
  };
  for (const Engine& engine : {kReference, kCpuDouble, kGpuDouble}) {
    const Pair pair(start, damping, mode, dt);
    Simulation s = simulate(pair.scene, pair.particles, engine);
    // One period; a one-sided spring does not act for three quarters of it.
    const auto steps = static_cast<int>(2 * M_PI / omega / dt);
    for (int n = 0; n < steps; n += 100) {
      ASSERT_TRUE(advance(s, 100));
      // Velocity Verlet's phase is off by (omega dt)^2/24, 6 (omega dt)^2/24 in all. Damping sees the half-step
      // velocity, omega dt/2 of a step too late, decay dt/2 relative. The moment at which a spring stops acting is
      // off by up to a step, omega dt of the speed.
      const double w = omega * dt;
      EXPECT_NEAR(extension_of(s), expected(s.time()),
                  std::abs(start) * (w * w + 8 * decay * dt + (mode == SpringMode::both ? 0 : 8 * w * w)))
          << engine.name() << " at " << s.time();
    }
    const Measurements m = measured(s);
    EXPECT_NEAR(m.momentum.x, 0, 1e-12);
    if (mode != SpringMode::both) {
      EXPECT_EQ(m.spring_energy, 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, SpringModes,
                         testing::Combine(testing::Values(SpringMode::both, SpringMode::compression,
                                                          SpringMode::extension),
                                          testing::Values(0.0, 5.0)));

// A chain of masses between two pinned ends. At rest the tension's horizontal part is the same in every link, its
// vertical part differs by m g from link to link, and each link is as long as its tension makes it: the discrete
// catenary.
TEST(Springs, HangInADiscreteCatenary) {
  constexpr int kLinks = 20;
  constexpr double kLength = 0.5, kLink = 2e4, kMass = 0.3, kSpan = 7;
  Scene scene = open_scene();
  scene.gravity = {0, -9.8, 0};
  scene.integrator = Integrator::velocity_verlet;
  scene.time_step = 5e-4;
  scene.materials = {{"link", 0.05, kMass, {1000, 0, 0}, 0.9, ""}};  // drag brings it to rest
  ParticleSet particles;
  std::vector<Spring> springs;
  for (int i = 0; i <= kLinks; ++i) add(particles, {kSpan * i / kLinks, 0, 0}, {0, 0, 0});
  for (std::uint64_t i = 1; i <= kLinks; ++i) springs.push_back({i, i + 1, kLength, kLink, 20});
  scene.structure = structure_of(springs, {1, kLinks + 1});

  const auto links = [&](double horizontal, std::vector<Vec3d>* to) {
    Vec3d at{0, 0, 0};
    for (int i = 0; i < kLinks; ++i) {
      const double vertical = (i - 0.5 * (kLinks - 1)) * kMass * 9.8;
      const double tension = std::hypot(horizontal, vertical), length = kLength + tension / kLink;
      at += (length / tension) * Vec3d{horizontal, vertical, 0};
      if (to != nullptr) to->push_back(at);
    }
    return at.x;
  };
  double low = 0, high = 1000;  // N
  for (int k = 0; k < 200; ++k) (links((low + high) / 2, nullptr) < kSpan ? low : high) = (low + high) / 2;
  std::vector<Vec3d> expected;
  links(low, &expected);
  ASSERT_NEAR(expected.back().x, kSpan, 1e-12);
  ASSERT_LT(expected[kLinks / 2].y, -2) << "it sags";

  Simulation s = simulate(scene, particles, kCpuDouble);
  ASSERT_TRUE(advance(s, 60000));
  ASSERT_LT(measured(s).max_speed, 1e-6) << "at rest";
  for (std::size_t i = 0; i < expected.size(); ++i) {
    // The remaining speed over the decay's rate.
    EXPECT_NEAR(s.positions()[i + 1].x, expected[i].x, 1e-6) << i;
    EXPECT_NEAR(s.positions()[i + 1].y, expected[i].y, 1e-6) << i;
  }
  // The ends carry the chain: a second's impulse equals that of gravity.
  const double before = s.ledger().impulse[Cause::hold].y;
  ASSERT_TRUE(advance(s, 2000));
  EXPECT_NEAR(s.ledger().impulse[Cause::hold].y - before, (kLinks + 1) * kMass * 9.8, 1e-5);
}

// Work is the kinetic energy that kicks add; here springs do all of it.
TEST(Springs, AccountForTheKineticEnergy) {
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
    for (const Engine& engine : {kReference, kCpuDouble, kGpuDouble}) {
      double error[2];
      for (int fine = 0; fine < 2; ++fine) {
        Pair pair(0.5, 2, SpringMode::both, fine == 0 ? 2e-3 : 1e-3);
        pair.scene.integrator = integrator;
        Simulation s = simulate(pair.scene, pair.particles, engine);
        ASSERT_TRUE(advance(s, fine == 0 ? 237 : 474));
        const Measurements m = measured(s);
        const SpringLedger& l = s.ledger().springs;
        EXPECT_NEAR(m.kinetic_energy, s.ledger().work[Cause::springs], 1e-12 * s.initial_energy());
        EXPECT_GT(l.dissipated, 0.1 * s.initial_energy());
        error[fine] = std::abs(s.initial_energy() - m.kinetic_energy - m.spring_energy - l.dissipated);
      }
      EXPECT_LT(error[1], 11) << "a tenth of what there was";
      EXPECT_LT(error[1], 0.7 * error[0]) << "the integrator's error falls with the step";
    }
  }
}

// Pulled apart at a steady speed: the spring breaks at the end of the step that sees it too long, not before.
TEST(Springs, BreakForEverWhenStretchedTooFar) {
  for (const Engine& engine : {kReference, kCpuDouble, kCpuSingle, kGpuDouble, kGpuSingle}) {
    Scene scene = open_scene();
    scene.time_step = 1.0 / 64;  // exact in binary, as all numbers below
    ParticleSet particles;
    add(particles, {0, 0, 0}, {0, 0, 0});
    add(particles, {4, 0, 0}, {1, 0, 0});
    Spring s{1, 2, 4, 0, 0};
    s.break_strain = 0.25;
    scene.structure = structure_of({s});
    Simulation simulation = simulate(scene, particles, engine);
    // The rest length is 4 m, so it tears above 5 m. After 64 steps it is 5 m long, at the start of step 66 5 + 1/64 m.
    ASSERT_TRUE(advance(simulation, 65));
    EXPECT_EQ(simulation.ledger().springs.broken, 0U);
    EXPECT_EQ(measured(simulation).springs, 1U);
    ASSERT_TRUE(advance(simulation, 1));
    EXPECT_EQ(simulation.ledger().springs.broken, 1U);
    EXPECT_EQ(measured(simulation).springs, 0U);
    EXPECT_EQ(simulation.broken_springs(), std::vector<std::uint64_t>{0});
    // Moved back together, it stays broken.
    ASSERT_TRUE(simulation.set_particle(2, {4.5, 0, 0}, {0, 0, 0}));
    ASSERT_TRUE(advance(simulation, 5));
    EXPECT_EQ(measured(simulation).springs, 0U);
  }
}

// Two overlapping particles with a spring as long as their distance: without contact they stay, with contact they are
// pushed apart.
TEST(Springs, KeepTheirEndsFromTouchingWhereAskedTo) {
  for (const Engine& engine : {kReference, kCpuDouble, kCpuSingle, kGpuDouble, kGpuSingle}) {
    for (const bool contact : {false, true}) {
      Scene scene = open_scene();
      ParticleSet particles = pair_on_x(scene, 0.25, {0, 0, 0}, {0, 0, 0});
      Spring s{1, 2, 0.75, 100, 0};
      s.contact = contact;
      s.break_strain = 0.5;
      scene.structure = structure_of({s});
      Simulation simulation = simulate(scene, particles, engine);
      EXPECT_EQ(measured(simulation).contacts, contact ? 1U : 0U);
      ASSERT_TRUE(advance(simulation, 10));
      EXPECT_EQ(simulation.positions()[0].x < 0, contact);
      if (contact) continue;
      // Once the spring is torn, they touch again.
      ASSERT_TRUE(simulation.set_particle(2, {2, 0, 0}, {0, 0, 0}));
      ASSERT_TRUE(advance(simulation, 1));
      EXPECT_EQ(simulation.ledger().springs.broken, 1U);
      ASSERT_TRUE(simulation.set_particle(2, {0.75, 0, 0}, {0, 0, 0}));
      EXPECT_EQ(measured(simulation).contacts, 1U);
    }
  }
}

TEST(Springs, ReachAcrossPeriodicFaces) {
  for (const Engine& engine : {kReference, kCpuDouble, kGpuDouble}) {
    Scene scene = open_scene();
    scene.domain.min = {0, 0, 0};
    scene.domain.max = {10, 10, 10};
    scene.domain.boundary = {Boundary::periodic, Boundary::open, Boundary::open};
    ParticleSet particles;
    add(particles, {0.5, 5, 5}, {0, 0, 0});
    add(particles, {9, 5, 5}, {0, 0, 0});
    scene.structure = structure_of({{1, 2, 1, 100, 0}});
    Simulation s = simulate(scene, particles, engine);
    EXPECT_NEAR(measured(s).spring_energy, 0.5 * 100 * 0.5 * 0.5, 1e-12);
    ASSERT_TRUE(advance(s, 1));
    EXPECT_LT(s.velocities()[0].x, 0);
    EXPECT_EQ(s.velocities()[0].x, -s.velocities()[1].x);
  }
}

TEST(Springs, ThatMakeNoSenseAreRefused) {
  Scene scene = open_scene();
  const ParticleSet particles = pair_on_x(scene, -1, {0, 0, 0}, {0, 0, 0});
  const auto refused = [&](const Spring& spring, std::vector<std::uint64_t> pinned = {}) {
    scene.structure = structure_of({spring}, std::move(pinned));
    const auto made = Simulation::create(scene, particles, make_backend(kCpuDouble));
    return made ? std::string() : made.error().findings.front().message;
  };
  EXPECT_EQ(refused({1, 2, 1, 1, 0}), "");
  EXPECT_EQ(refused({1, 1, 1, 1, 0}), "ties particle 1 to itself");
  EXPECT_EQ(refused({1, 7, 1, 1, 0}), "names particle 7; there is none of this id");
  EXPECT_EQ(refused({1, 2, 0, 1, 0}), "rest_length 0 must be a number greater than 0");
  EXPECT_EQ(refused({1, 2, 1, -1, 0}), "stiffness -1 must be 0 or more");
  EXPECT_EQ(refused({1, 2, 1, 1, -2}), "damping -2 must be 0 or more");
  EXPECT_EQ(refused({1, 2, 1, 1, 0, 0}), "break_strain 0 must be greater than 0");
  EXPECT_EQ(refused({1, 2, 1, 1, 0}, {9}), "names particle 9; there is none of this id");
  EXPECT_EQ(refused({1, 2, 1, 1, 0}, {2, 1}), "ids must be unique and ascending");

  Structure grouped = *structure_of({{1, 2, 1, 1, 0}});
  grouped.groups = {{"springs[0]", 1}, {"springs[1]", 2}};
  scene.structure = std::make_shared<Structure>(grouped);
  const auto made = Simulation::create(scene, particles, make_backend(kCpuDouble));
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().findings.front().message,
            "springs[1] ends at spring 2; must be 1 to 1, the number of springs");
}

}  // namespace
}  // namespace hooke::test
