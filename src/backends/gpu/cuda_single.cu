// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/gpu/cuda_backend.h"
#include "hooke/backends/gpu/cuda_device.h"
#include "hooke/backends/gpu/gpu_backend.h"

namespace hooke::gpu {

std::unique_ptr<Backend> make_single_cuda_backend(const CudaOptions& options, int threads) {
  return std::make_unique<GpuBackend<CudaDevice, float>>(CudaDevice(options.device), threads);
}

}  // namespace hooke::gpu
