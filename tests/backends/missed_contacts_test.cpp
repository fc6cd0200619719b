// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The neighbour list is kept for many steps. However particles move, it misses no contact meanwhile.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <ostream>

#include "busy_scenes.h"
#include "hooke/backends/cpu/isa.h"
#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

// Touching pairs, by a sweep along y over all particles; on periodic axes the nearest image counts.
std::uint64_t true_contacts(const Simulation& simulation) {
  struct Ball {
    Vec3d x;
    double radius;
  };
  const ParticleSet& p = simulation.particles();
  const Scene& scene = simulation.scene();
  std::vector<Ball> balls(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) balls[i] = {p.position[i], scene.materials[p.material[i]].radius};
  std::sort(balls.begin(), balls.end(), [](const Ball& a, const Ball& b) { return a.x.y < b.x.y; });
  double reach = 0;
  for (const Material& m : scene.materials) reach = std::max(reach, 2 * m.radius);
  // Between nearest images along x or z.
  const auto between = [&](double a, double b, int axis) {
    const double d = b - a, length = scene.domain.length(axis);
    const bool periodic = scene.domain.boundary[static_cast<std::size_t>(axis)] == Boundary::periodic;
    return periodic && std::abs(d) > length / 2 ? d - std::copysign(length, d) : d;
  };
  std::uint64_t contacts = 0;
  for (std::size_t a = 0; a < balls.size(); ++a) {
    const Vec3d x = balls[a].x;
    for (std::size_t b = a + 1; b < balls.size() && balls[b].x.y - x.y < reach; ++b) {
      const double dx = between(x.x, balls[b].x.x, 0);
      if (std::abs(dx) >= reach) continue;
      const Vec3d d{dx, balls[b].x.y - x.y, between(x.z, balls[b].x.z, 2)};
      if (std::sqrt(dot(d, d)) < balls[a].radius + balls[b].radius) ++contacts;
    }
  }
  return contacts;
}

struct Motion {
  const char* name;
  double spacing;  // of the lattice at the start, m
  std::function<void(Scene&)> rules;
  std::function<Vec3d(const Vec3d& x, std::uint64_t i)> velocity;
  std::function<void(Simulation&)> halfway;  // what is done halfway, if anything
};

void PrintTo(const Motion& motion, std::ostream* os) { *os << motion.name; }

Vec3d noise(std::uint64_t i, double speed) {
  const auto u = random4(21, i);
  return {speed * (2 * u[0] - 1), speed * (2 * u[1] - 1), speed * (2 * u[2] - 1)};
}

void push_apart(Simulation& s) {
  std::vector<std::uint64_t> ids(s.ids().begin(), s.ids().end());
  for (const std::uint64_t id : ids) ASSERT_TRUE(s.apply_impulse(id, noise(id, 60)));
}

const Motion kMotions[] = {
    {"thermal", 0.48, [](Scene&) {}, [](const Vec3d&, std::uint64_t i) { return noise(i, 3); }, nullptr},
    // One particle in twenty moves ten times as far as the rest.
    {"fast_free", 0.8, [](Scene&) {}, [](const Vec3d&, std::uint64_t i) { return noise(i, i % 20 == 0 ? 10.0 : 1.0); },
     nullptr},
    {"translation", 0.48, [](Scene&) {}, [](const Vec3d&, std::uint64_t) { return Vec3d{8, 0, -6}; }, nullptr},
    {"rotation", 0.48, [](Scene& s) { s.domain.boundary = {Boundary::open, Boundary::spring, Boundary::open}; },
     [](const Vec3d& x, std::uint64_t) { return Vec3d{6 * x.z, 0, -6 * x.x}; }, nullptr},
    {"sudden_gravity", 0.52, [](Scene& s) { s.gravity = {0, -2000, 0}; },
     [](const Vec3d&, std::uint64_t) { return Vec3d{0, 0, 0}; }, nullptr},
    // Two halves approach by ten radii in a hundredth of a second.
    {"shock", 0.48, [](Scene&) {}, [](const Vec3d& x, std::uint64_t) { return Vec3d{x.x < 0 ? 12.0 : -12.0, 0, 0}; },
     nullptr},
    {"explosion", 0.48, [](Scene&) {}, [](const Vec3d&, std::uint64_t) { return Vec3d{0, 0, 0}; }, push_apart},
};

class Motions : public testing::TestWithParam<std::tuple<Motion, Integrator, Precision>> {};

TEST_P(Motions, MissNoContact) {
  const auto& [motion, integrator, precision] = GetParam();
  Scene scene = open_scene();
  mix_materials(scene, 0.25);
  scene.materials[1].radius =
      0.375;  // sums of radii that single precision holds exactly: no touch is a matter of rounding
  scene.materials[2].radius = 0.125;
  scene.integrator = integrator;
  scene.gravity = {0, -9.8, 0};
  scene.domain.min = {-4, -4, -4};
  scene.domain.max = {4, 4, 4};
  scene.domain.boundary = {Boundary::periodic, Boundary::spring, Boundary::periodic};
  motion.rules(scene);
  const int across = static_cast<int>(6.5 / motion.spacing);
  const double corner = -motion.spacing * (across - 1) / 2.0;
  ParticleSet particles = lattice(scene, {across, across, across}, {corner, corner, corner}, motion.spacing, 0.1, 22);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    particles.velocity[i] = motion.velocity(particles.position[i], particles.id[i]);
  }
  Simulation simulation = simulate(scene, particles, {"cpu", precision, 2, "", true});
  const int steps = 80;
  for (int step = 1; step <= steps; ++step) {
    if (step == steps / 2 && motion.halfway) motion.halfway(simulation);
    const auto taken = simulation.step();
    ASSERT_EQ(simulation.neighbour_statistics().missed_contacts, 0U) << "in step " << step;
    if (!taken) break;  // approaches too fast to be resolved: see failure_test.cpp
    // Figures come from the rows that the force pass reads.
    ASSERT_EQ(measured(simulation).contacts, true_contacts(simulation)) << "after step " << step;
  }
  EXPECT_GT(simulation.step_count(), 20);
  EXPECT_GT(simulation.neighbour_statistics().rebuilds, 1U);
  EXPECT_LT(simulation.neighbour_statistics().rebuilds, static_cast<std::uint64_t>(steps)) << "some lists were kept";
}

INSTANTIATE_TEST_SUITE_P(All, Motions,
                         testing::Combine(testing::ValuesIn(kMotions),
                                          testing::Values(Integrator::symplectic_euler, Integrator::velocity_verlet),
                                          testing::Values(Precision::single_precision, Precision::double_precision)),
                         [](const auto& instance) {
                           return std::string(std::get<0>(instance.param).name) +
                                  (std::get<1>(instance.param) == Integrator::velocity_verlet ? "_verlet" : "_euler") +
                                  (std::get<2>(instance.param) == Precision::single_precision ? "_single" : "_double");
                         });

// Some grains shoot through a calm block, each straight at its neighbour. Only these grains are checked in each step:
// the list is kept, and no contact is missed. The gaps are wider than the list's skin, so that a fast grain meets a
// grain that its list does not hold.
class Spray : public testing::TestWithParam<std::tuple<Integrator, Precision, Boundary, std::string>> {};

TEST_P(Spray, MissesNoContactAndKeepsTheList) {
  const auto& [integrator, precision, boundary, isa] = GetParam();
  if (const auto isas = available_isas();
      std::none_of(isas.begin(), isas.end(), [&](const Isa& has) { return has.name == isa; })) {
    GTEST_SKIP() << "this processor has no " << isa;
  }
  Scene scene = open_scene();
  mix_materials(scene, 0.125);
  for (Material& material : scene.materials) material.radius = 0.125;
  scene.integrator = integrator;
  scene.gravity = {0, 0, 0};
  scene.domain.min = {-5.6, -4, -5.6};
  scene.domain.max = {5.6, 4, 5.6};
  scene.domain.boundary = {boundary, Boundary::spring, boundary};
  const double spacing = 0.39;
  ParticleSet particles = lattice(scene, {28, 12, 28}, {-5.3, -2.2, -5.3}, spacing, 0.02, 23);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vec3d along{0.3, 0, 0.2};  // the block as a whole
    particles.velocity[i] = along + noise(particles.id[i], 0.2);
    if (particles.id[i] % 2500 == 7) particles.velocity[i].x = 20;
  }
  Simulation simulation = simulate(scene, particles, {"cpu", precision, 2, isa, true});
  for (int step = 1; step <= 24; ++step) {
    ASSERT_TRUE(advance(simulation, 1));
    ASSERT_EQ(simulation.neighbour_statistics().missed_contacts, 0U) << "in step " << step;
    if (step % 8 != 0) continue;
    ASSERT_EQ(measured(simulation).contacts, true_contacts(simulation)) << "after step " << step;
  }
  // The grains cross a diameter every three steps.
  EXPECT_LE(simulation.neighbour_statistics().rebuilds, 3U);
}

std::string spray_name(const testing::TestParamInfo<Spray::ParamType>& instance) {
  const auto& [integrator, precision, boundary, isa] = instance.param;
  return BusyKind{boundary, integrator, precision}.name() + "_" + isa;
}

INSTANTIATE_TEST_SUITE_P(All, Spray,
                         testing::Combine(testing::Values(Integrator::symplectic_euler, Integrator::velocity_verlet),
                                          testing::Values(Precision::single_precision, Precision::double_precision),
                                          testing::Values(Boundary::spring, Boundary::periodic, Boundary::open),
                                          testing::Values("portable", "avx2", "avx512")),
                         spray_name);

// A stream passes some grains that are pinned. Held grains stay where they are while their surroundings move on: the
// pinned grains are the outliers.
class Stream : public testing::TestWithParam<std::tuple<Integrator, Precision, Boundary>> {};

TEST_P(Stream, MissesNoContactWithGrainsThatAreHeld) {
  const auto& [integrator, precision, boundary] = GetParam();
  Scene scene = open_scene();
  mix_materials(scene, 0.125);
  for (Material& material : scene.materials) material.radius = 0.125;
  scene.materials[1].fixed = true;
  scene.integrator = integrator;
  scene.gravity = {0, 0, 0};
  scene.domain.min = {-5.6, -4, -5.6};
  scene.domain.max = {5.6, 4, 5.6};
  scene.domain.boundary = {boundary, Boundary::spring, boundary};
  ParticleSet particles = lattice(scene, {28, 12, 28}, {-5.3, -2.2, -5.3}, 0.39, 0.02, 25);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const bool pinned = particles.id[i] % 300 == 7;
    particles.material[i] = pinned ? 1 : 0;
    particles.velocity[i] = pinned ? Vec3d{0, 0, 0} : Vec3d{5, 0, 2} + noise(particles.id[i], 0.1);
  }
  Simulation simulation = simulate(scene, particles, {"cpu", precision, 2, "", true});
  for (int step = 1; step <= 40; ++step) {
    ASSERT_TRUE(advance(simulation, 1));
    ASSERT_EQ(simulation.neighbour_statistics().missed_contacts, 0U) << "in step " << step;
    ASSERT_EQ(measured(simulation).contacts, true_contacts(simulation)) << "after step " << step;
  }
  EXPECT_GT(measured(simulation).contacts, 10U);
  EXPECT_LE(simulation.neighbour_statistics().rebuilds, 10U)
      << "a list is kept for several steps: outliers are at stake";
}

std::string stream_name(const testing::TestParamInfo<Stream::ParamType>& instance) {
  const auto& [integrator, precision, boundary] = instance.param;
  return BusyKind{boundary, integrator, precision}.name();
}

INSTANTIATE_TEST_SUITE_P(All, Stream,
                         testing::Combine(testing::Values(Integrator::symplectic_euler, Integrator::velocity_verlet),
                                          testing::Values(Precision::single_precision, Precision::double_precision),
                                          testing::Values(Boundary::spring, Boundary::periodic)),
                         stream_name);

// Large balls shot through a cloud of small balls; the radii are as ten to one, so each size has a grid of its own.
class Mixture : public testing::TestWithParam<std::tuple<Precision, Boundary, std::string>> {};

TEST_P(Mixture, MissesNoContact) {
  const auto& [precision, boundary, isa] = GetParam();
  if (const auto isas = available_isas();
      std::none_of(isas.begin(), isas.end(), [&](const Isa& has) { return has.name == isa; })) {
    GTEST_SKIP() << "this processor has no " << isa;
  }
  Scene scene = open_scene();
  mix_materials(scene, 0.0625);
  scene.materials[1].radius = 0.625;  // single precision holds sums of radii exactly
  scene.materials[1].mass = 400;
  scene.materials[2].radius = 0.125;
  scene.domain.min = {-3, -3, -3};
  scene.domain.max = {3, 3, 3};
  scene.domain.boundary = {boundary, Boundary::spring, boundary};
  ParticleSet particles = lattice(scene, {20, 20, 20}, {-2.8, -2.8, -2.8}, 0.29, 0.05, 24);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const bool large = particles.id[i] % 400 == 7;
    particles.material[i] = large ? 1 : particles.id[i] % 5 == 0 ? 2 : 0;
    particles.velocity[i] = noise(particles.id[i], large ? 2.0 : 0.5);
  }
  Simulation simulation = simulate(scene, particles, {"cpu", precision, 2, isa, true});
  for (int step = 1; step <= 24; ++step) {
    const auto taken = simulation.step();
    ASSERT_EQ(simulation.neighbour_statistics().missed_contacts, 0U) << "in step " << step;
    ASSERT_TRUE(taken) << step;
    if (step % 8 != 0) continue;
    ASSERT_EQ(measured(simulation).contacts, true_contacts(simulation)) << "after step " << step;
  }
  EXPECT_GT(measured(simulation).contacts, 300U);
}

std::string mixture_name(const testing::TestParamInfo<Mixture::ParamType>& instance) {
  const auto& [precision, boundary, isa] = instance.param;
  return BusyKind{boundary, Integrator::symplectic_euler, precision}.name() + "_" + isa;
}

INSTANTIATE_TEST_SUITE_P(All, Mixture,
                         testing::Combine(testing::Values(Precision::single_precision, Precision::double_precision),
                                          testing::Values(Boundary::spring, Boundary::periodic, Boundary::open),
                                          testing::Values("portable", "avx2", "avx512")),
                         mixture_name);

}  // namespace
}  // namespace hooke::test
