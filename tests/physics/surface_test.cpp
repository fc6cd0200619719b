// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Friction, tension and cohesion: the law by itself, two bodies against an integration written out here, and analytic
// solutions.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

constexpr double kNone = INFINITY;
using Law = ContactLaw<double>;

const Vec3d kNormal{1, 0, 0};

SurfaceForces<double> forces(double overlap, const Vec3d& w, const Law& law) {
  return contact_forces(overlap, kNormal, w, law);
}

TEST(SurfaceLaw, IsTheLinearLawWhereSurfacesDoNothing) {
  const Law law{{1000, 5, 3}, {}};
  const Vec3d w{0.25, -0.5, 0.125};
  for (const double approach : {-4.0, -0.1, 0.0, 2.0}) {
    const Vec3d at{approach, w.y, w.z};
    const SurfaceForces<double> f = forces(0.01, at, law);
    const ContactForces<double> linear = contact_forces(0.01, kNormal, at, law.linear);
    const Vec3d off = f.total() - linear.total();
    EXPECT_LE(std::sqrt(dot(off, off)), 1e-15 * std::sqrt(dot(linear.total(), linear.total())));
    EXPECT_EQ(f.friction, (Vec3d{0, 0, 0}));
  }
}

TEST(SurfaceLaw, HoldsTheTangentialForceBelowFrictionTimesWhatPresses) {
  const Law law{{1000, 5, 3}, {0.5, kNone, 0, 0}};
  const Vec3d sticks = forces(0.01, {1, 0.75, 0}, law).total();  // presses 10 + 3 N, holds back 8 * 0.75 = 6 N < 6.5 N
  EXPECT_NEAR(sticks.y, 6, 1e-14);
  const SurfaceForces<double> slides = forces(0.01, {1, 3, 4}, law);  // 40 N > 6.5 N
  EXPECT_NEAR(slides.friction.y, 6.5 * 3 / 5, 1e-14);
  EXPECT_NEAR(slides.friction.z, 6.5 * 4 / 5, 1e-14);
  EXPECT_EQ(slides.linear.shear, (Vec3d{0, 0, 0}));
  EXPECT_EQ(slides.linear.damping, (Vec3d{3, 0, 0})) << "the normal part stays";
  EXPECT_EQ(forces(0.01, {-10, 3, 4}, law).total(), (Vec3d{-20, 0, 0})) << "what pulls does not hold back";
}

TEST(SurfaceLaw, PullsNoHarderThanTension) {
  const Law pushes{{1000, 0, 3}, {kNone, 0, 0, 0}};
  EXPECT_EQ(forces(0.01, {-2, 0, 0}, pushes).total(), (Vec3d{4, 0, 0})) << "10 - 6 N still push";
  EXPECT_EQ(forces(0.01, {-5, 0, 0}, pushes).total(), (Vec3d{0, 0, 0}));
  const Law pulls{{1000, 0, 3}, {kNone, 1.5, 0, 0}};
  EXPECT_EQ(forces(0.01, {-5, 0, 0}, pulls).total(), (Vec3d{-1.5, 0, 0}));
}

TEST(SurfaceLaw, CoheresAcrossAGap) {
  const Law law{{1000, 5, 3}, {kNone, kNone, 4, 0.25}};
  const Vec3d w{1, 2, 3};
  EXPECT_EQ(forces(-0.125, w, law).total(), (Vec3d{-2, 0, 0})) << "half the strength at half the range, no dashpot";
  EXPECT_EQ(forces(-0.25, w, law).total(), (Vec3d{0, 0, 0}));
  EXPECT_EQ(forces(0.01, {0, 0, 0}, law).total(), (Vec3d{6, 0, 0})) << "10 - 4 N";
}

TEST(SurfaceLaw, StoresWhatItsConservativePartTakes) {
  const Law law{{1000, 5, 3}, {kNone, kNone, 4, 0.25}};
  constexpr double h = 1e-6;
  for (const double overlap : {-0.24, -0.1, -0.01, 0.01, 0.1}) {
    const double slope = (contact_energy(overlap + h, law) - contact_energy(overlap - h, law)) / (2 * h);
    EXPECT_NEAR(slope, forces(overlap, {0, 0, 0}, law).total().x, 1e-6);
  }
  EXPECT_EQ(contact_energy(-0.25, law), 0);
  EXPECT_EQ(contact_energy(-1.0, law), 0);
}

TEST(SurfaceLaw, OfAPairIsEqualAndOpposite) {
  const Law law{{1000, 5, 3}, {0.3, 1, 4, 0.25}};
  for (std::uint64_t k = 0; k < 200; ++k) {
    const auto u = random4(3, k), s = random4(4, k);
    const Vec3d w{8 * (u[0] - 0.5), 8 * (u[1] - 0.5), 8 * (u[2] - 0.5)};
    const double overlap = 0.3 * (u[3] - 0.8);
    const double length = std::sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    const Vec3d n{s[0] / length, s[1] / length, s[2] / length};
    EXPECT_EQ(contact_forces(overlap, n, w, law).total(), -contact_forces(overlap, -n, -w, law).total());
  }
}

// Two bodies, written out with branches: Coulomb's cap, tension and cohesion as the scene's keys describe them.
struct TwoBodies {
  double k, c_s, c_d, mu, tension, strength, range, radius, m_1, m_2, dt;
  Vec3d x_1, v_1, x_2, v_2;

  Vec3d force_on_1() const {
    const Vec3d x = x_1 - x_2;
    const double d = std::sqrt(dot(x, x)), overlap = 2 * radius - d;
    const Vec3d n = (1 / d) * x, w = v_2 - v_1;
    if (overlap <= -range) return {0, 0, 0};
    if (overlap <= 0) return -strength * (1 + overlap / range) * n;
    const double w_n = dot(w, n), pressed = k * overlap + c_d * w_n;
    const Vec3d w_t = w - w_n * n;
    Vec3d tangential = (c_s + c_d) * w_t;
    const double most = mu * std::max(0.0, pressed), size = std::sqrt(dot(tangential, tangential));
    if (size > most) tangential = (most / size) * tangential;
    return (std::max(pressed, -tension) - strength) * n + tangential;
  }
  void step() {
    const Vec3d f = force_on_1();
    v_1 += (dt / m_1) * f;
    v_2 -= (dt / m_2) * f;
    x_1 += dt * v_1;
    x_2 += dt * v_2;
  }
};

struct SurfaceCase {
  const char* name;
  SurfaceCoefficients<double> surface;
};

void PrintTo(const SurfaceCase& c, std::ostream* os) { *os << c.name; }

class Surfaces : public testing::TestWithParam<SurfaceCase> {};

TEST_P(Surfaces, FollowTheIntegrationOfTwoBodies) {
  const auto& [friction, tension, cohesion, range] = GetParam().surface;
  TwoBodies bodies{1000, 6, 4, friction, tension, cohesion, range, 0.5, 1, 2, 1e-4, {}, {}, {}, {}};
  bodies.x_1 = {0, 0, 0};
  bodies.v_1 = {0.5, 1, 0.25};  // oblique: slides first, then sticks where friction is strong
  bodies.x_2 = {1.03125, 0.0625, 0};
  bodies.v_2 = {-0.5, -0.25, 0};

  Scene scene = open_scene();
  scene.time_step = bodies.dt;
  scene.materials = {{"a", 0.5, 1, {1000, 6, 4}, 0, ""}, {"b", 0.5, 2, {1000, 6, 4}, 0, ""}};
  for (Material& m : scene.materials) m.surface = GetParam().surface;
  ParticleSet particles;
  add(particles, bodies.x_1, bodies.v_1, 0);
  add(particles, bodies.x_2, bodies.v_2, 1);
  std::vector<Simulation> runs;
  for (const Engine& engine : {kReference, kCpuDouble, kCpuSingle, kGpuDouble, kGpuSingle})
    runs.push_back(simulate(scene, particles, engine));

  constexpr int kSteps = 3000;  // past the end of the contact
  bool touched = false;
  for (int n = 0; n < kSteps; ++n) {
    bodies.step();
    const Vec3d apart = bodies.x_2 - bodies.x_1;
    touched = touched || dot(apart, apart) < 1;
    if (n % 100 != 99) continue;
    for (Simulation& run : runs) {
      ASSERT_TRUE(advance(run, 100));
      // Doubles round by 1e-16 m, floats by 1e-7 m; a contact found a step later moves by 1e-4 s of 1 m/s times dt.
      const double tolerance = run.backend_info().precision == Precision::double_precision ? 1e-12 : 1e-4;
      for (const auto& [at, x] : {std::pair{0, bodies.x_1}, std::pair{1, bodies.x_2}}) {
        const Vec3d off = run.positions()[static_cast<std::size_t>(at)] - x;
        EXPECT_LE(std::sqrt(dot(off, off)), tolerance) << run.backend_info().device << " at step " << n + 1;
      }
    }
  }
  EXPECT_TRUE(touched);
}

INSTANTIATE_TEST_SUITE_P(Of, Surfaces,
                         testing::Values(SurfaceCase{"weak_friction", {0.1, kNone, 0, 0}},
                                         SurfaceCase{"strong_friction", {0.8, kNone, 0, 0}},
                                         SurfaceCase{"no_friction", {0, kNone, 0, 0}},
                                         SurfaceCase{"no_tension", {kNone, 0, 0, 0}},
                                         SurfaceCase{"cohesion", {kNone, kNone, 5, 0.125}},
                                         SurfaceCase{"cohesion_of_contacts_alone", {kNone, kNone, 5, 0}},
                                         SurfaceCase{"all", {0.4, 0, 5, 0.0625}}),
                         [](const auto& instance) { return instance.param.name; });

// On a floor where only friction brakes, a block slides v^2 / (2 mu g) and stops; the ledger accounts for its energy.
TEST(Friction, StopsASlidingParticleWhereTheBooksSay) {
  constexpr double kMu = 0.25, kSpeed = 2, kG = 8, kDt = 1e-4;
  for (const Engine& engine : {kReference, kCpuDouble, kGpuDouble}) {
    Scene scene = open_scene();
    scene.time_step = kDt;
    scene.gravity = {0, -kG, 0};
    scene.domain.boundary[1] = Boundary::spring;
    scene.domain.min.y = 0;
    // Damping of 2 sqrt(k m) keeps the block from hopping, shear makes it stick at the end: below 1e-3 m/s.
    scene.materials = {{"block", 0.5, 1, {1e4, 2000, 200}, 0, ""}};
    scene.materials[0].surface.friction = kMu;
    ParticleSet particles;
    add(particles, {0, 0.5 - kG / 1e4, 0}, {kSpeed, 0, 0});
    Simulation s = simulate(scene, particles, engine);
    const double time = kSpeed / (kMu * kG);
    ASSERT_TRUE(advance(s, static_cast<std::int64_t>(0.5 * time / kDt)));
    EXPECT_NEAR(s.velocities()[0].x, kSpeed / 2, 1e-9) << "uniformly braked";
    EXPECT_NEAR(s.ledger().work[Cause::wall], -0.75 * 0.5 * kSpeed * kSpeed, 1e-9);
    ASSERT_TRUE(advance(s, static_cast<std::int64_t>(0.6 * time / kDt)));
    // One step of braking, and the creep while it sticks: 1e-3 m/s for m/c_s seconds.
    EXPECT_NEAR(s.positions()[0].x, kSpeed * kSpeed / (2 * kMu * kG), 0.5 * kSpeed * kDt + 1e-5);
    EXPECT_NEAR(s.velocities()[0].x, 0, 1e-9);
  }
}

// A slope with a tangent below mu holds a particle, except for the creep of its dashpot; on a steeper slope it slides.
TEST(Friction, HoldsOnASlopeUpToItsAngle) {
  for (const double tangent : {0.2, 0.6}) {
    constexpr double kMu = 0.4, kG = 10, kShear = 1e4;
    Scene scene = open_scene();
    scene.time_step = 5e-5;
    scene.gravity = {kG * tangent, -kG, 0};  // the floor level, gravity askew
    scene.domain.boundary[1] = Boundary::spring;
    scene.domain.min.y = 0;
    scene.materials = {{"block", 0.5, 1, {1e4, kShear, 200}, 0, ""}};
    scene.materials[0].surface.friction = kMu;
    ParticleSet particles;
    add(particles, {0, 0.5 - kG / 1e4, 0}, {0, 0, 0});
    Simulation s = simulate(scene, particles, kCpuDouble);
    ASSERT_TRUE(advance(s, 20000));
    const double expected = tangent < kMu ? kG * tangent / (kShear + 200) : kG * (tangent - kMu) * s.time();
    EXPECT_NEAR(s.velocities()[0].x, expected, 1e-3 * expected);
  }
}

// Cohesion is conservative: without dashpots energy comes back, up to the integrator's error, and two particles at rest
// within its range come together and stay.
TEST(Cohesion, KeepsTheEnergyAndBinds) {
  for (const Engine& engine : {kReference, kCpuDouble, kGpuDouble}) {
    Scene scene = open_scene();
    scene.integrator = Integrator::velocity_verlet;
    scene.time_step = 1e-4;
    scene.materials = {{"a", 0.5, 1, {1000, 0, 0}, 0, ""}};
    scene.materials[0].surface = {kNone, kNone, 5, 0.25};
    ParticleSet particles;
    add(particles, {0, 0, 0}, {0, 0, 0});
    add(particles, {1.125, 0, 0}, {0, 0, 0});
    Simulation s = simulate(scene, particles, engine);
    EXPECT_NEAR(s.initial_energy(), -5 * 0.125 * 0.125 / (2 * 0.25), 1e-15);
    double nearest = 2, furthest = 0;
    for (int n = 0; n < 200; ++n) {
      ASSERT_TRUE(advance(s, 50));
      const double apart = s.positions()[1].x - s.positions()[0].x;
      nearest = std::min(nearest, apart);
      furthest = std::max(furthest, apart);
      EXPECT_NEAR(accounted_energy(s), s.initial_energy(), 1e-5) << "(omega dt)^2 of 0.16 J";
    }
    EXPECT_LT(nearest, 1);
    EXPECT_NEAR(furthest, 1.125, 1e-3);
    EXPECT_NEAR(measured(s).kinetic_energy, s.ledger().work[Cause::contact_spring], 1e-12);
  }
}

// Across a periodic face, and to a wall that the particle doesn't touch.
TEST(Cohesion, ReachesAcrossPeriodicFacesAndToWalls) {
  Scene scene = open_scene();
  scene.domain.min = {0, 0, 0};
  scene.domain.max = {8, 8, 8};
  scene.domain.boundary = {Boundary::periodic, Boundary::spring, Boundary::open};
  scene.materials[0].surface = {kNone, kNone, 4, 0.25};
  ParticleSet particles;
  add(particles, {0.5, 4, 4}, {0, 0, 0});
  add(particles, {7.375, 4, 4}, {0, 0, 0});  // 1.125 apart across the face: half the range
  add(particles, {4, 0.625, 4}, {0, 0, 0});  // half the range from the wall
  for (const Engine& engine : {kReference, kCpuDouble, kGpuDouble}) {
    Simulation s = simulate(scene, particles, engine);
    EXPECT_NEAR(measured(s).wall_force.y, -2, 1e-12);
    EXPECT_EQ(measured(s).contacts, 0U) << "nothing touches";
    ASSERT_TRUE(advance(s, 1));
    EXPECT_NEAR(s.velocities()[0].x, -2 * scene.time_step, 1e-12);
    EXPECT_NEAR(s.velocities()[1].x, 2 * scene.time_step, 1e-12);
    EXPECT_NEAR(s.velocities()[2].y, -2 * scene.time_step, 1e-12);
  }
}

// A fixed particle does not move by a bit, and is a partner of infinite mass: a ball bounces off it as off a wall.
TEST(Fixed, ParticlesDoNotMoveAndTurnOthersBack) {
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
    Scene scene = open_scene();
    scene.integrator = integrator;
    scene.gravity = {0, -9.8, 0};
    scene.materials = {{"ball", 0.5, 1, {1000, 2, 3}, 0, ""}, {"post", 0.5, 2, {1000, 2, 3}, 0, ""}};
    scene.materials[1].fixed = true;
    ParticleSet particles;
    add(particles, {0, 3, 0}, {0, 0, 0}, 0);
    add(particles, {0, 0, 0}, {0, 0, 0}, 1);
    Scene walled = scene;  // the same contact with a wall, which the ball's centre meets half a metre higher
    walled.domain.boundary[1] = Boundary::spring;
    walled.domain.min.y = 0;
    ParticleSet alone;
    add(alone, {0, 2.5, 0}, {0, 0, 0}, 0);
    for (const Engine& engine : {kReference, kCpuDouble, kGpuDouble}) {
      Simulation s = simulate(scene, particles, engine), expected = simulate(walled, alone, engine);
      ASSERT_TRUE(advance(s, 800) && advance(expected, 800));
      EXPECT_GT(s.velocities()[0].y, 0) << "on its way up";
      EXPECT_EQ(s.positions()[1], (Vec3d{0, 0, 0}));
      EXPECT_EQ(s.velocities()[1], (Vec3d{0, 0, 0}));
      EXPECT_NEAR(s.positions()[0].y, expected.positions()[0].y + 0.5, 1e-11);
      EXPECT_NEAR(s.velocities()[0].y, expected.velocities()[0].y, 1e-10);
      EXPECT_GT(s.ledger().impulse[Cause::hold].y, 1) << "kept from falling, and from being knocked down";
    }
  }
}

// The ledger's kinetic balance holds with sliding contacts, and friction is a separate cause in it.
TEST(Friction, IsInTheLedger) {
  for (const Engine& engine : {kReference, kCpuDouble, kGpuDouble}) {
    Scene scene = open_scene();
    scene.materials[0].surface.friction = 0.2;
    ParticleSet particles = cloud(scene, 60, {0, 0, 0}, {4, 3, 3}, 1, 5);
    Simulation s = simulate(scene, particles, engine);
    const double before = measured(s).kinetic_energy;
    ASSERT_TRUE(advance(s, 200));
    const Measurements now = measured(s);
    double all = 0, scale = 0;
    for (std::size_t cause = 0; cause < kCauses; ++cause) {
      all += s.ledger().work.of[cause];
      scale += std::abs(s.ledger().work.of[cause]);
    }
    EXPECT_LT(s.ledger().work[Cause::contact_friction], -0.01 * before);
    EXPECT_NEAR(now.kinetic_energy - before, all, 1e-12 * scale);
  }
}

}  // namespace
}  // namespace hooke::test
