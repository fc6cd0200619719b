// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// What only a GPU shows: the bits of launched kernels. Skipped where there is none; tests/parity has the same scenes
// with a loop in place of the GPU.

#include <gtest/gtest.h>

#include "hooke/backends/gpu/cuda_backend.h"
#include "parity/scenarios.h"
#include "support/engines.h"

namespace hooke::test {
namespace {

class Device : public testing::TestWithParam<Scenario> {
 protected:
  void SetUp() override {
    if (const auto gpu = cuda_device(0); !gpu) GTEST_SKIP() << gpu.error().text();
  }
};

TEST_P(Device, HasTheBitsOfTheCpu) {
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
    for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
      SCOPED_TRACE(testing::PrintToString(integrator) + ", " + testing::PrintToString(precision));
      Scene scene = GetParam().scene;
      scene.integrator = integrator;
      scene.precision = precision;
      Simulation cpu = simulate(scene, GetParam().particles, {"cpu", precision, 1, ""});
      auto backend = make_cuda_backend({precision, 0, 1});
      ASSERT_TRUE(backend) << backend.error().text();
      auto gpu = Simulation::create(scene, GetParam().particles, std::move(*backend), {.allow_unstable_step = true});
      ASSERT_TRUE(gpu) << gpu.error().text();
      const auto cpu_steps = cpu.step(GetParam().steps), gpu_steps = gpu->step(GetParam().steps);
      ASSERT_EQ(gpu_steps.has_value(), cpu_steps.has_value());
      EXPECT_EQ(gpu->state_hash(), cpu.state_hash());
      EXPECT_EQ(gpu->ledger(), cpu.ledger());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Device, testing::ValuesIn(scenarios()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace hooke::test
