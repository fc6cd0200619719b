// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include "support/colliders.h"
#include "support/engines.h"
#include "support/particles.h"
#include "support/same_bits.h"

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

}  // namespace hooke::test
