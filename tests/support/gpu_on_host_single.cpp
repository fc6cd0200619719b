// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <utility>

#include "hooke/backends/gpu/gpu_backend.h"
#include "support/gpu_on_host.h"

namespace hooke::test {

std::unique_ptr<Backend> make_single_gpu_on_host(int threads, gpu::HostDevice device) {
  return std::make_unique<gpu::GpuBackend<gpu::HostDevice, float>>(std::move(device), threads);
}

}  // namespace hooke::test
