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
  int major = 0, minor = 0;       ///< compute capability
  std::uint64_t memory = 0;       ///< bytes
  std::uint64_t free_memory = 0;  ///< bytes
};

/// How many GPUs there are. Error::Kind::bad_input: none, with what was looked for: a driver, a device.
Expected<int> cuda_device_count();

/// A GPU by its number. bad_input where it can't be used.
Expected<CudaDeviceInfo> cuda_device(int index);

/// What a particle that touches others takes of a GPU's memory, bytes: what a dense heap needs, neighbours included.
inline constexpr std::uint64_t cuda_bytes_per_particle(Precision precision, Integrator integrator) {
  const bool single = precision == Precision::single_precision;
  const std::uint64_t accelerations = integrator == Integrator::velocity_verlet ? (single ? 24 : 48) : 0;
  return (single ? 190 : 290) + accelerations;
}

/// The most particles that a GPU's back end can number.
inline constexpr std::uint64_t kMostCudaParticles = std::uint64_t{1} << 28U;

/// What of a scene this back end does not have, in the words of a finding; empty where it has all of it.
std::vector<Finding> cuda_refusals(const Scene& scene, std::size_t particles);

/// The back end of a GPU (backends/gpu/gpu_backend.h). bad_input where the device can't be used.
Expected<std::unique_ptr<Backend>> make_cuda_backend(const CudaOptions& options);

namespace gpu {

// Its two precisions, which take the compiler long.
std::unique_ptr<Backend> make_single_cuda_backend(const CudaOptions& options, int threads);
std::unique_ptr<Backend> make_double_cuda_backend(const CudaOptions& options, int threads);

}  // namespace gpu
}  // namespace hooke
