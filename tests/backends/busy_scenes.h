// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include "support/colliders.h"
#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {

/// The walls of a busy scene, its integrator and so on.
struct BusyKind {
  Boundary boundary;
  Integrator integrator;
  Precision precision;
  bool colliders = false;
  bool surfaces = false;

  std::string name() const {
    const char* walls = boundary == Boundary::spring ? "spring" : boundary == Boundary::open ? "open" : "periodic";
    return std::string(walls) + (integrator == Integrator::velocity_verlet ? "_verlet" : "_euler") +
           (precision == Precision::single_precision ? "_single" : "_double") + (colliders ? "_colliders" : "") +
           (surfaces ? "_surfaces" : "");
  }
};

inline void PrintTo(const BusyKind& kind, std::ostream* os) { *os << kind.name(); }

/// A block of three materials that falls apart and is as large as several tiles of the neighbour list: rebuilds,
/// departures, wrapping and drag all happen within a hundred steps. On request colliders of every kind are in the way.
inline Scene busy_scene(const BusyKind& kind) {
  Scene scene = open_scene();
  mix_materials(scene, 0.25);
  scene.integrator = kind.integrator;
  scene.precision = kind.precision;
  scene.gravity = {1, -9.8, 0.5};
  scene.domain.min = {-3, 0, -3};
  scene.domain.max = {5, 9, 4};
  scene.domain.boundary = {kind.boundary, Boundary::spring, kind.boundary};
  if (kind.surfaces) add_surfaces(scene);
  if (kind.colliders) add_every_collider(scene, {1, 4, 0.5}, 8);
  return scene;
}

inline ParticleSet busy_particles(const Scene& scene) {
  ParticleSet particles = lattice(scene, {12, 14, 13}, {-2.7, 0.4, -2.7}, 0.5, 0.1, 5);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const auto u = random4(6, i);
    particles.velocity[i] = {6 * (u[0] - 0.5), 6 * (u[1] - 0.5), 6 * (u[2] - 0.5)};
  }
  return particles;
}

class BusyScenes : public testing::TestWithParam<BusyKind> {
 protected:
  BusyScenes() : scene_(busy_scene(GetParam())), particles_(busy_particles(scene_)) {}

  Engine engine(int threads) const { return {"cpu", GetParam().precision, threads, ""}; }

  Scene scene_;
  ParticleSet particles_;
};

inline auto all_busy_kinds() {
  std::vector<BusyKind> kinds;
  for (const Boundary b : {Boundary::spring, Boundary::open, Boundary::periodic}) {
    for (const Integrator i : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
      for (const Precision p : {Precision::single_precision, Precision::double_precision}) kinds.push_back({b, i, p});
    }
  }
  kinds.push_back({Boundary::spring, Integrator::symplectic_euler, Precision::single_precision, true});
  kinds.push_back({Boundary::open, Integrator::velocity_verlet, Precision::double_precision, true});
  kinds.push_back({Boundary::periodic, Integrator::velocity_verlet, Precision::single_precision, true, true});
  kinds.push_back({Boundary::spring, Integrator::symplectic_euler, Precision::double_precision, true, true});
  return testing::ValuesIn(kinds);
}

/// Expects that two simulations hold the same bits: particles, ledger and figures.
inline void expect_same_bits(const Simulation& a, const Simulation& b) {
  EXPECT_EQ(a.state_hash(), b.state_hash());
  EXPECT_EQ(a.particles().position, b.particles().position);
  EXPECT_EQ(a.particles().acceleration, b.particles().acceleration);
  EXPECT_EQ(a.ledger(), b.ledger());
  const Measurements m = measured(a), n = measured(b);
  EXPECT_EQ(m.contacts, n.contacts);
  EXPECT_EQ(m.wall_contacts, n.wall_contacts);
  EXPECT_EQ(m.kinetic_energy, n.kinetic_energy);
  EXPECT_EQ(m.potential_energy, n.potential_energy);
  EXPECT_EQ(m.elastic_energy, n.elastic_energy);
  EXPECT_EQ(m.wall_elastic_energy, n.wall_elastic_energy);
  EXPECT_EQ(m.attraction_energy, n.attraction_energy);
  EXPECT_EQ(m.momentum, n.momentum);
  EXPECT_EQ(m.momentum_scale, n.momentum_scale);
  EXPECT_EQ(m.centre_of_mass, n.centre_of_mass);
  EXPECT_EQ(m.max_speed, n.max_speed);
  EXPECT_EQ(m.max_overlap_ratio, n.max_overlap_ratio);
  EXPECT_EQ(m.max_pair_overlap_ratio, n.max_pair_overlap_ratio);
  EXPECT_EQ(m.mean_overlap_ratio, n.mean_overlap_ratio);
  EXPECT_EQ(m.min, n.min);
  EXPECT_EQ(m.max, n.max);
  EXPECT_EQ(m.wall_force, n.wall_force);
  EXPECT_EQ(m.collider_elastic_energy, n.collider_elastic_energy);
  EXPECT_EQ(m.colliders, n.colliders);
}

}  // namespace hooke::test
