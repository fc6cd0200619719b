// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/gpu/gpu_backend.h"
#include "support/gpu_on_host.h"

namespace hooke::test {

std::unique_ptr<Backend> make_double_gpu_on_host(int threads, gpu::ItemOrder order) {
  return std::make_unique<gpu::GpuBackend<gpu::HostDevice, double>>(gpu::HostDevice(order), threads);
}

}  // namespace hooke::test
