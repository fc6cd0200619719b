// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Edits by a caller between steps.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

class Edits : public testing::TestWithParam<std::tuple<Engine, Integrator>> {
 protected:
  Edits() {
    scene_ = open_scene();
    scene_.integrator = std::get<1>(GetParam());
    scene_.materials.push_back({"b", 0.25, 2, {500, 1, 1}, 0, ""});
  }
  Simulation start() const { return simulate(scene_, pair_on_x(scene_, -1, {1, 0, 0}, {0, 0, 0}), engine()); }
  static const Engine& engine() { return std::get<0>(GetParam()); }

  Scene scene_;
};

TEST_P(Edits, AddParticlesWithIdsNeverUsedBefore) {
  Simulation s = start();
  EXPECT_EQ(s.next_id(), 3U);
  const NewParticle three[] = {{0, {5, 0, 0}, {0, 1, 0}}, {1, {7, 0, 0}, {0, 0, 0}}, {0, {9, 0, 0}, {0, 0, 0}}};
  const auto ids = s.add_particles(three);
  ASSERT_TRUE(ids);
  EXPECT_EQ(*ids, (std::vector<std::uint64_t>{3, 4, 5}));
  EXPECT_EQ(s.particle_count(), 5U);
  const std::uint64_t gone[] = {5, 3};
  ASSERT_TRUE(s.remove_particles(gone));
  EXPECT_EQ(s.particle_count(), 3U);
  ASSERT_TRUE(advance(s, 2));
  EXPECT_EQ(*s.add_particles({three, 1}), (std::vector<std::uint64_t>{6}));
  EXPECT_EQ(std::vector<std::uint64_t>(s.ids().begin(), s.ids().end()), (std::vector<std::uint64_t>{1, 2, 4, 6}));
  EXPECT_EQ(s.particles().material, (std::vector<std::uint16_t>{0, 1, 1, 0}));
  ASSERT_TRUE(advance(s, 2));
  EXPECT_EQ(s.particle_count(), 4U);
}

TEST_P(Edits, RefuseBadNewParticlesAltogether) {
  Simulation s = start();
  const NewParticle bad[] = {
      {0, {5, 0, 0}, {0, 1, 0}}, {9, {7, 0, 0}, {0, 0, 0}}, {0, {NAN, 0, 0}, {0, 0, 0}}, {0, {0, 500, 0}, {0, 0, 0}}};
  const auto ids = s.add_particles(bad);
  ASSERT_FALSE(ids);
  EXPECT_EQ(ids.error().kind, Error::Kind::bad_input);
  EXPECT_EQ(ids.error().findings.size(), 3U);
  EXPECT_EQ(ids.error().findings[0].where, "new particle 1");
  EXPECT_EQ(s.particle_count(), 2U) << "none was added";
  EXPECT_EQ(s.next_id(), 3U);
}

TEST_P(Edits, RemoveNoneWhereOneIsUnknown) {
  Simulation s = start();
  const std::uint64_t ids[] = {1, 77};
  const auto removed = s.remove_particles(ids);
  ASSERT_FALSE(removed);
  EXPECT_EQ(removed.error().findings[0].where, "particle 77");
  EXPECT_EQ(s.particle_count(), 2U);
  const std::uint64_t twice[] = {1, 1};
  EXPECT_TRUE(s.remove_particles(twice));
  EXPECT_EQ(s.particle_count(), 1U);
  const std::uint64_t last[] = {2};
  EXPECT_TRUE(s.remove_particles(last));
  ASSERT_TRUE(advance(s, 5));
  EXPECT_EQ(s.particle_count(), 0U);
}

TEST_P(Edits, ApplyAnImpulse) {
  Simulation s = start();
  ASSERT_TRUE(s.apply_impulse(2, {4, 0, -2}));
  EXPECT_EQ(s.velocities()[1], (Vec3d{2, 0, -1})) << "of mass 2";
  ASSERT_TRUE(advance(s, 10));
  EXPECT_NEAR(s.velocities()[1].x, 2, 1e-6);
  EXPECT_FALSE(s.apply_impulse(99, {1, 0, 0}));
  EXPECT_FALSE(s.apply_impulse(1, {NAN, 0, 0}));
  EXPECT_LT(momentum_drift(measured(s), s.ledger(), s.initial_momentum()), 1e-7) << "what hands give is accounted for";
}

TEST_P(Edits, SetAParticle) {
  Simulation s = start();
  ASSERT_TRUE(s.set_particle(1, {-3, 4, 5}, {0, 0, 1}));
  EXPECT_EQ(s.positions()[0], (Vec3d{-3, 4, 5}));
  ASSERT_TRUE(advance(s, 10));
  EXPECT_NEAR(s.positions()[0].z, 5.01, 1e-6);
  EXPECT_FALSE(s.set_particle(99, {0, 0, 0}, {0, 0, 0}));
  EXPECT_FALSE(s.set_particle(1, {0, 0, 200}, {0, 0, 0})) << "outside the domain";
  EXPECT_FALSE(s.set_particle(1, {0, 0, 0}, {0, INFINITY, 0}));
  EXPECT_LT(momentum_drift(measured(s), s.ledger(), s.initial_momentum()), 1e-7);
}

TEST_P(Edits, PushParticlesWithForces) {
  Simulation s = start();
  const std::uint64_t ids[] = {2, 1};
  const Vec3d forces[] = {{4, 0, -2}, {0, 0, 0}};
  ASSERT_TRUE(s.set_external_forces(ids, forces));
  ASSERT_TRUE(advance(s, 10));
  const double dt = s.scene().time_step;
  // Velocity Verlet's first half kick is by the forces of the step before.
  const double kicks = s.scene().integrator == Integrator::velocity_verlet ? 9.5 : 10;
  EXPECT_NEAR(s.velocities()[1].x, 2 * kicks * dt, 1e-6) << "of mass 2";
  EXPECT_NEAR(s.velocities()[1].z, -1 * kicks * dt, 1e-6);
  EXPECT_EQ(s.velocities()[0], (Vec3d{1, 0, 0})) << "whose force is none";
  ASSERT_TRUE(s.set_external_forces({}, {}));
  ASSERT_TRUE(advance(s, 10));
  EXPECT_NEAR(s.velocities()[1].x, 20 * dt, 1e-6);
  const Ledger ledger = s.ledger();
  EXPECT_NEAR(ledger.impulse[Cause::external].x, 40 * dt, 1e-6);
  EXPECT_NEAR(ledger.work[Cause::external], 0.5 * 2 * (400 + 100) * dt * dt, 1e-6) << "its kinetic energy";
  EXPECT_LT(momentum_drift(measured(s), ledger, s.initial_momentum()), 1e-7);
  // Particles that are added in between change nothing of what is booked.
  ASSERT_TRUE(s.set_external_forces(ids, forces));
  ASSERT_TRUE(advance(s, 3));
  const NewParticle added[] = {{0, {0, 5, 0}, {0, 1, 0}}};
  ASSERT_TRUE(s.add_particles(added));
  ASSERT_TRUE(advance(s, 3));
  EXPECT_LT(momentum_drift(measured(s), s.ledger(), s.initial_momentum()), 1e-7);
}

TEST_P(Edits, RefuseBadForcesAltogether) {
  Simulation s = start();
  const std::uint64_t ids[] = {1, 2}, unknown[] = {1, 99}, twice[] = {2, 2};
  const Vec3d forces[] = {{0, 2, 0}, {0, 0, 0}}, bad[] = {{0, NAN, 0}, {INFINITY, 0, 0}};
  ASSERT_TRUE(s.set_external_forces(ids, forces));
  const auto first_fault = [&](std::span<const std::uint64_t> of, std::span<const Vec3d> by) {
    const auto set = s.set_external_forces(of, by);
    return set ? std::string("none") : set.error().text();
  };
  EXPECT_NE(first_fault(unknown, forces).find("particle 99: there is none of this id"), std::string::npos);
  EXPECT_NE(first_fault(twice, forces).find("particle 2: has more than one force"), std::string::npos);
  EXPECT_NE(first_fault(ids, bad).find("particle 2: force"), std::string::npos) << "both are named";
  EXPECT_NE(first_fault(ids, {forces, 1}).find("1 forces for 2 ids"), std::string::npos);
  ASSERT_TRUE(advance(s, 10));
  EXPECT_GT(s.velocities()[0].y, 0) << "the old ones still push";
}

TEST_P(Edits, CopyTheColumnsThatAreWanted) {
  Simulation s = start();
  ASSERT_TRUE(s.apply_impulse(2, {1.0 / 3, 0, 0}));
  ASSERT_TRUE(advance(s, 3));
  std::vector<Vec3f> positions(2), accelerations(2, {7, 7, 7});
  ASSERT_TRUE(
      s.copy_particles(ParticleColumns<float>{nullptr, nullptr, positions.data(), nullptr, accelerations.data()}));
  const bool verlet = s.scene().integrator == Integrator::velocity_verlet;
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(positions[i], vec_cast<float>(s.positions()[i]));
    EXPECT_EQ(accelerations[i], verlet ? vec_cast<float>(s.particles().acceleration[i]) : Vec3f(7, 7, 7));
  }
  std::vector<std::uint64_t> ids(2);
  std::vector<std::uint16_t> materials(2);
  std::vector<Vec3d> velocities(2);
  ASSERT_TRUE(
      s.copy_particles(ParticleColumns<double>{ids.data(), materials.data(), nullptr, velocities.data(), nullptr}));
  EXPECT_EQ(ids, s.particles().id);
  EXPECT_EQ(materials, s.particles().material);
  EXPECT_EQ(velocities, s.particles().velocity);
}

TEST_P(Edits, ReplaceAMaterial) {
  Simulation s = simulate(scene_, pair_on_x(scene_, 0.1, {0, 0, 0}, {0, 0, 0}), engine());
  Material b = scene_.materials[1];
  b.radius = 0.5;
  ASSERT_TRUE(s.set_material(b));
  EXPECT_EQ(s.scene().materials[1].radius, 0.5);
  EXPECT_NEAR(measured(s).max_overlap_ratio, 0.35, 1e-6);
  ASSERT_TRUE(advance(s, 5));
  b.mass = -1;
  EXPECT_FALSE(s.set_material(b));
  b.name = "c";
  EXPECT_FALSE(s.set_material(b));
  EXPECT_EQ(s.scene().materials[1].mass, 2);
}

// A mass that changes during a run: gravity pulls at the new mass from then on, and everything is accounted for.
TEST_P(Edits, AccountForANewMass) {
  scene_.gravity = {0, -9.8, 0};
  scene_.materials[1].contact = scene_.materials[0].contact;
  Simulation s = start();
  ASSERT_TRUE(advance(s, 10));
  Material heavy = scene_.materials[1];
  heavy.mass = 20;
  ASSERT_TRUE(s.set_material(heavy));
  ASSERT_TRUE(advance(s, 200));
  // A fall may round in the same direction in every step, by half a unit in the last place each.
  const double unit = engine().precision == Precision::single_precision ? 0x1p-24 : 0x1p-53;
  EXPECT_LT(momentum_drift(measured(s), s.ledger(), s.initial_momentum()), 200 * unit);
}

// A particle may press deeper into a soft wall than its radius; it can still be pushed.
TEST_P(Edits, ReachParticlesDeepInAWall) {
  scene_.domain.boundary[1] = Boundary::spring;
  scene_.materials[0].contact.stiffness = 10;
  ParticleSet particles;
  add(particles, {0, -99.6, 0}, {0, -10, 0});
  Simulation s = simulate(scene_, particles, engine());
  ASSERT_TRUE(advance(s, 80));
  ASSERT_LT(s.positions()[0].y, -100) << "its centre is beyond the wall";
  EXPECT_TRUE(s.apply_impulse(1, {0, 1, 0}));
  EXPECT_TRUE(s.restore(s.state()));
}

INSTANTIATE_TEST_SUITE_P(Engines, Edits,
                         testing::Combine(testing::Values(kReference, kCpuDouble, kCpuSingle),
                                          testing::Values(Integrator::symplectic_euler, Integrator::velocity_verlet)),
                         [](const auto& instance) {
                           const bool verlet = std::get<1>(instance.param) == Integrator::velocity_verlet;
                           return std::get<0>(instance.param).name() + (verlet ? "_verlet" : "_euler");
                         });

}  // namespace
}  // namespace hooke::test
