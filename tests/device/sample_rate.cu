// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "sample_rate.h"

#include <chrono>

#include "hooke/backends/gpu/cuda_device.h"
#include "sample_engine.h"

namespace hooke::test {

double sample_rate(const Scene& scene, const ParticleSet& particles) {
  using Clock = std::chrono::steady_clock;
  SampleEngine<gpu::CudaDevice> engine(gpu::CudaDevice(0), scene, particles);
  for (int k = 0; k < 3; ++k) engine.step();
  (void)engine.state();
  const auto from = Clock::now();
  double seconds = 0;
  std::int64_t steps = 0;
  do {
    for (int k = 0; k < 100; ++k) engine.step();
    (void)engine.state();
    steps += 100;
    seconds = std::chrono::duration<double>(Clock::now() - from).count();
  } while (seconds < 1);
  return static_cast<double>(steps) / seconds;
}

}  // namespace hooke::test
