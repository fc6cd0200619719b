// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "cell_loop.h"

#include <gtest/gtest.h>

#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

TEST(CellLoop, GoesWhereTheReferenceGoes) {
  Scene scene = open_scene();
  scene.gravity = {1, -9.8, 0.5};
  scene.domain.min = {-3, 0, -4};
  scene.domain.max = {5, 40, 3};
  scene.domain.boundary = {Boundary::spring, Boundary::spring, Boundary::spring};
  const ParticleSet particles = lattice(scene, {8, 9, 7}, {-2.7, 0.4, -3.6}, 0.95, 0.1, 5);
  Simulation reference = simulate(scene, particles, kReference);
  bench::CellLoop<double> loop(scene, particles);
  ASSERT_TRUE(advance(reference, 300));
  for (int step = 0; step < 300; ++step) loop.step();

  ASSERT_EQ(loop.particles().size(), particles.size());
  const Measurements now = measured(reference);
  EXPECT_GT(now.contacts, 500U);
  EXPECT_GT(now.wall_contacts, 50U);
  for (const auto& p : loop.particles()) {
    const Vec3d x = p.x - reference.positions()[p.index], v = p.v - reference.velocities()[p.index];
    EXPECT_LT(dot(x, x), 1e-18) << p.index;
    EXPECT_LT(dot(v, v), 1e-14) << p.index;
  }
}

}  // namespace
}  // namespace hooke::test
