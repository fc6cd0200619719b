// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The scheme that Hooke's is measured against computes the same physics, up to the order of its sums.

#include "sample_engine.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hooke/backends/gpu/host_device.h"
#include "support/engines.h"
#include "support/particles.h"

namespace hooke::test {
namespace {

TEST(SampleEngine, MovesParticlesAsHookeDoes) {
  Scene scene = open_scene();
  scene.materials.resize(1);
  scene.precision = Precision::single_precision;
  scene.gravity = {0.3, -9.8, 0.1};
  scene.domain.min = {-2, -2, -2};
  scene.domain.max = {7, 7, 7};
  scene.domain.boundary = {Boundary::spring, Boundary::spring, Boundary::spring};
  const ParticleSet particles = lattice(scene, {8, 8, 8}, {-1.9, -1.9, -1.9}, 0.98, 0.02, 1);
  Simulation simulation = simulate(scene, particles, kCpuSingle);
  SampleEngine<gpu::HostDevice> sample(gpu::HostDevice(), scene, particles);
  ASSERT_TRUE(advance(simulation, 40));
  for (int k = 0; k < 40; ++k) sample.step();
  const auto state = sample.state();
  double farthest = 0;
  for (std::size_t k = 0; k < state.size(); ++k) {
    const Vec3d off = vec_cast<double>(state[k].x) - simulation.particles().position[k];
    farthest = std::max(farthest, std::sqrt(dot(off, off)));
  }
  // Found: 1.2e-7, a quarter of the rounding of a coordinate of 7 m. A contact that is missed moves a particle by far
  // more.
  EXPECT_LT(farthest, 2e-6);
  EXPECT_GT(measured(simulation).contacts, 1000U);
}

}  // namespace
}  // namespace hooke::test
