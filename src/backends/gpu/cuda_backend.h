// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/core/backend.h"

namespace hooke {

struct CudaOptions {
  Precision precision = Precision::single_precision;
  int device = 0;   ///< as the CUDA runtime numbers them
  int threads = 0;  ///< of the host, for measurements; 0: as many as the machine has
};

/// A GPU as `hooke info --devices` lists it.
struct CudaDeviceInfo {
  std::string name;
  std::string compute_capability;  ///< "9.0"
  std::uint64_t memory = 0;        ///< bytes
  std::uint64_t free_memory = 0;   ///< bytes
};

/// The GPUs that can be used, in the order of their numbers. Error::Kind::bad_input: there is none, with what was looked
/// for: a driver, a device.
Expected<std::vector<CudaDeviceInfo>> cuda_devices();

/// The back end of a GPU (backends/gpu/gpu_backend.h). bad_input where the device can't be used.
Expected<std::unique_ptr<Backend>> make_cuda_backend(const CudaOptions& options);

namespace gpu {

// Its two precisions, which take the compiler long.
std::unique_ptr<Backend> make_single_cuda_backend(const CudaOptions& options, int threads);
std::unique_ptr<Backend> make_double_cuda_backend(const CudaOptions& options, int threads);

}  // namespace gpu
}  // namespace hooke
