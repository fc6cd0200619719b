// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Two particles, and one against a wall: the engine against analytic solutions.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <ostream>

#include "hooke/physics/stability.h"
#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

using Complex = std::complex<double>;

// A contact along its normal: m_eff s'' = -k s - c s', s the overlap.
struct Oscillator {
  double k, c, m_eff;
  double s0, rate0;  // at t = 0

  double omega2() const { return k / m_eff; }
  double gamma() const { return c / m_eff; }

  // The continuous solution (underdamped).
  double overlap(double t) const {
    const double decay = gamma() / 2;
    const double omega_d = std::sqrt(omega2() - decay * decay);
    return std::exp(-decay * t) * (s0 * std::cos(omega_d * t) + (rate0 + decay * s0) / omega_d * std::sin(omega_d * t));
  }

  // Symplectic Euler solved exactly: s_n = A p^n + B q^n, p and q the roots of z^2 - (2 - w - g) z + (1 - g).
  double euler_overlap(int n, double dt, double start_rate) const {
    const double w = omega2() * dt * dt, g = gamma() * dt;
    const Complex root = std::sqrt(Complex((2 - w - g) * (2 - w - g) - 4 * (1 - g)));
    const Complex p = ((2 - w - g) + root) / 2.0, q = ((2 - w - g) - root) / 2.0;
    const double s1 = s0 + dt * (start_rate + dt * (-omega2() * s0 - gamma() * start_rate));
    const Complex a = (s1 - s0 * q) / (p - q), b = s0 - a;
    return (a * std::pow(p, n) + b * std::pow(q, n)).real();
  }
  // Velocity Verlet's positions equal those of symplectic Euler with velocities half a step behind. So start Euler such
  // that one kick of a whole step leads to the half-step velocity.
  double verlet_overlap(int n, double dt) const {
    const double half_rate = rate0 + dt / 2 * (-omega2() * s0 - gamma() * rate0);
    const double w = omega2() * dt * dt, g = gamma() * dt;
    // Step back from (s_1, half_rate): half_rate = u + dt (-omega2 s0 - gamma u).
    const double start_rate = (half_rate + w / dt * s0) / (1 - g);
    return euler_overlap(n, dt, start_rate);
  }
};

struct Contact {
  std::string name;
  double mass_1, mass_2;  // mass_2 infinite: a wall
};

void PrintTo(const Contact& contact, std::ostream* os) { *os << contact.name; }

class Bodies : public testing::TestWithParam<std::tuple<Contact, Integrator>> {
 protected:
  Contact contact() const { return std::get<0>(GetParam()); }
  bool wall() const { return std::isinf(contact().mass_2); }
  bool verlet() const { return std::get<1>(GetParam()) == Integrator::velocity_verlet; }

  Oscillator oscillator(double k, double c, double s0, double rate0) const {
    return {k, c, effective_mass(contact().mass_1, contact().mass_2), s0, rate0};
  }

  Simulation start(const Oscillator& o, double dt, const Engine& engine = kReference) const {
    Scene scene = open_scene();
    scene.time_step = dt;
    scene.integrator = std::get<1>(GetParam());
    scene.materials = {{"a", 0.5, contact().mass_1, {o.k, 7, o.c}, 0, ""}};
    ParticleSet particles;
    if (wall()) {
      scene.domain.boundary[1] = Boundary::spring;
      scene.domain.min.y = 0;
      add(particles, {0.25, 0.5 - o.s0, 0}, {0, -o.rate0, 0});
      return simulate(scene, particles, engine);
    }
    scene.materials.push_back({"b", 0.75, contact().mass_2, {o.k, 7, o.c}, 0, ""});
    scene.contacts = {{0, 1, {o.k, 7, o.c}}};
    // Both particles move, and so does the centre of mass.
    particles = pair_on_x(scene, o.s0, {0.3 + o.rate0, 0, 0}, {0.3, 0, 0});
    return simulate(scene, particles, engine);
  }

  double overlap(const Simulation& simulation) const {
    const auto x = simulation.positions();
    return wall() ? 0.5 - x[0].y : 1.25 - (x[1].x - x[0].x);
  }
  double rate(const Simulation& simulation) const {
    const auto v = simulation.velocities();
    return wall() ? -v[0].y : v[0].x - v[1].x;
  }

  // Largest difference from `expected` over `duration`, in units of the largest overlap.
  double error(const Oscillator& o, double dt, double duration, const std::function<double(int)>& expected,
               const Engine& engine = kReference) const {
    Simulation simulation = start(o, dt, engine);
    double worst = 0;
    const int steps = static_cast<int>(std::lround(duration / dt));
    for (int n = 1; n <= steps; ++n) {
      if (!advance(simulation, 1)) break;
      EXPECT_GT(overlap(simulation), 0) << "still in contact";
      worst = std::max(worst, std::abs(overlap(simulation) - expected(n)));
    }
    return worst / (o.s0 + o.rate0 / std::sqrt(o.omega2()));
  }
};

TEST_P(Bodies, FollowTheDiscreteSolutionToRounding) {
  const Oscillator o = oscillator(1000, 3, 0.01, 0.5);
  const double dt = 0.1 / std::sqrt(o.omega2());
  const auto exact = [&](int n) { return verlet() ? o.verlet_overlap(n, dt) : o.euler_overlap(n, dt, o.rate0); };
  const double quarter_period = 1.5 / std::sqrt(o.omega2());
  EXPECT_LT(error(o, dt, quarter_period, exact, kReference), 1e-13);
  EXPECT_LT(error(o, dt, quarter_period, exact, kCpuDouble), 1e-13);
  EXPECT_LT(error(o, dt, quarter_period, exact, kCpuSingle), 1e-4) << "float positions around 1 resolve 6e-8";
}

TEST_P(Bodies, ConvergeToTheContinuousSolution) {
  const auto ratio_of_errors = [&](double damping) {
    const Oscillator o = oscillator(1000, damping, 0.01, 0.5);
    const double duration = 1.6 / std::sqrt(o.omega2());
    const auto error_at = [&](int steps) {
      const double dt = duration / steps;
      return error(o, dt, duration, [&](int n) { return o.overlap(n * dt); });
    };
    return error_at(100) / error_at(200);
  };
  EXPECT_NEAR(ratio_of_errors(3), 2, 0.1) << "first order: damping sees a velocity half a step or a step behind";
  EXPECT_NEAR(ratio_of_errors(0), verlet() ? 4 : 2, 0.1) << "undamped, velocity Verlet is of second order";
}

TEST_P(Bodies, ReboundWithTheRestitutionOfADampedOscillator) {
  for (const double ratio : {0.0, 0.05, 0.3, 0.7}) {
    const double m_eff = effective_mass(contact().mass_1, contact().mass_2);
    const Oscillator o = oscillator(1000, 2 * ratio * std::sqrt(1000 * m_eff), 0, 0.5);
    Simulation simulation = start({o.k, o.c, o.m_eff, -1e-4, 0.5}, 2e-3 / std::sqrt(o.omega2()));
    ASSERT_TRUE(advance(simulation, 3000));
    EXPECT_EQ(measured(simulation).contacts + measured(simulation).wall_contacts, 0U);
    const double restitution = std::exp(-M_PI * ratio / std::sqrt(1 - ratio * ratio));
    EXPECT_NEAR(-rate(simulation) / 0.5, restitution, 5e-3) << "damping ratio " << ratio;
  }
}

TEST_P(Bodies, KeepTheirCentreOfMassInUniformMotion) {
  if (wall()) GTEST_SKIP() << "a wall takes momentum";
  const Oscillator o = oscillator(1000, 3, 0.01, 0.5);
  Simulation simulation = start(o, 0.001);
  const Vec3d before = measured(simulation).centre_of_mass, momentum = measured(simulation).momentum;
  ASSERT_TRUE(advance(simulation, 200));
  const Vec3d after = measured(simulation).centre_of_mass;
  EXPECT_NEAR(after.x, before.x + 0.2 * momentum.x / (contact().mass_1 + contact().mass_2), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Contacts, Bodies,
                         testing::Combine(testing::Values(Contact{"equal", 1, 1}, Contact{"unequal", 0.4, 30},
                                                          Contact{"wall", 2, INFINITY}),
                                          testing::Values(Integrator::symplectic_euler, Integrator::velocity_verlet)),
                         [](const auto& instance) {
                           const bool verlet = std::get<1>(instance.param) == Integrator::velocity_verlet;
                           return std::get<0>(instance.param).name + (verlet ? "_verlet" : "_euler");
                         });

TEST(OneParticle, RestsOnTheFloorWhereSpringBalancesWeight) {
  Scene scene = open_scene();
  scene.gravity = {0, -9.8, 0};
  scene.domain.boundary[1] = Boundary::spring;
  scene.domain.min.y = 0;
  scene.materials[0].mass = 2;
  ParticleSet particles;
  add(particles, {0, 0.5 - 2 * 9.8 / 1000, 0}, {0, 0, 0});
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
    scene.integrator = integrator;
    Simulation simulation = simulate(scene, particles, kReference);
    ASSERT_TRUE(advance(simulation, 1000));
    EXPECT_NEAR(simulation.positions()[0].y, 0.5 - 2 * 9.8 / 1000, 1e-14);
    EXPECT_NEAR(measured(simulation).wall_force.y, 2 * 9.8, 1e-10);
    EXPECT_NEAR(simulation.ledger().impulse[Cause::wall].y, 2 * 9.8 * 1000 * scene.time_step, 1e-10);
  }
}

TEST(OneParticle, FallsAsItsIntegratorSays) {
  Scene scene = open_scene();
  scene.gravity = {1, -9.8, 0.5};
  ParticleSet particles;
  add(particles, {0, 50, 0}, {2, 0, 0});
  const double dt = scene.time_step;
  const int n = 1000;
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
    scene.integrator = integrator;
    for (const Engine& engine : {kReference, kCpuDouble, kGpuDouble}) {
      Simulation simulation = simulate(scene, particles, engine);
      ASSERT_TRUE(advance(simulation, n));
      // Symplectic Euler: x_n = g dt^2 n (n + 1) / 2; velocity Verlet is exact.
      const double ahead = integrator == Integrator::symplectic_euler ? dt : 0;
      const double t = n * dt;
      EXPECT_NEAR(simulation.positions()[0].x, 2 * t + 1 * t * (t + ahead) / 2, 1e-12);
      EXPECT_NEAR(simulation.positions()[0].y, 50 - 9.8 * t * (t + ahead) / 2, 1e-12);
      EXPECT_NEAR(simulation.velocities()[0].y, -9.8 * t, 1e-12);
    }
  }
}

TEST(OneParticle, SlowsDownByDrag) {
  Scene scene = open_scene();
  scene.materials[0].drag = 2;
  scene.materials[0].mass = 4;
  ParticleSet particles;
  add(particles, {0, 0, 0}, {3, -1, 0});
  for (const Engine& engine : {kReference, kCpuDouble, kGpuDouble}) {
    Simulation simulation = simulate(scene, particles, engine);
    ASSERT_TRUE(advance(simulation, 1000));
    const double left = std::pow(1 - scene.time_step * 2 / 4, 1000);
    EXPECT_NEAR(simulation.velocities()[0].x, 3 * left, 1e-12);
    EXPECT_NEAR(simulation.velocities()[0].y, -left, 1e-12);
    EXPECT_NEAR(simulation.ledger().impulse[Cause::drag].x, 4 * 3 * (left - 1), 1e-10);
  }
}

}  // namespace
}  // namespace hooke::test
