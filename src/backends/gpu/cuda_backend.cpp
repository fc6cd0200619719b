// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/gpu/cuda_backend.h"

#include <cuda_runtime.h>

#include <algorithm>
#include <exception>
#include <thread>

#include "hooke/base/format.h"

namespace hooke {
namespace {

Unexpected no_device(const std::string& why) { return fail(Error::Kind::bad_input, "cuda", why); }

}  // namespace

Expected<int> cuda_device_count() {
  // The runtime has no word of its own for a machine without a driver: it finds one that is too old, of version 0.
  int driver = 0;
  if (cudaDriverGetVersion(&driver) != cudaSuccess || driver == 0)
    return no_device("no NVIDIA driver was found on this machine (libcuda.so.1)");
  int runtime = 0, count = 0;
  cudaRuntimeGetVersion(&runtime);
  const cudaError_t result = cudaGetDeviceCount(&count);
  if (result == cudaErrorInsufficientDriver) {
    return no_device(formatted("the NVIDIA driver is for CUDA {}.{}; this build needs one for CUDA {}.{} or later",
                               driver / 1000, driver % 1000 / 10, runtime / 1000, runtime % 1000 / 10));
  }
  if (result == cudaErrorNoDevice || (result == cudaSuccess && count == 0))
    return no_device("the NVIDIA driver knows no GPU on this machine");
  if (result != cudaSuccess) return no_device(cudaGetErrorString(result));
  return count;
}

Expected<CudaDeviceInfo> cuda_device(int index) {
  const auto count = cuda_device_count();
  if (!count) return fail(count.error());
  if (index < 0 || index >= *count)
    return no_device(formatted("there is no GPU {}; this machine has {}", index, *count));
  int current = 0;
  cudaGetDevice(&current);
  cudaDeviceProp properties{};
  std::size_t free_bytes = 0, all_bytes = 0;
  cudaError_t found = cudaGetDeviceProperties(&properties, index);
  if (found == cudaSuccess) found = cudaSetDevice(index);
  if (found == cudaSuccess) found = cudaMemGetInfo(&free_bytes, &all_bytes);
  cudaSetDevice(current);
  if (found != cudaSuccess) return no_device(formatted("GPU {}: {}", index, cudaGetErrorString(found)));
  if (properties.major < 8) {
    return no_device(formatted("{} has compute capability {}.{}; 8.0 or later is needed",
                               static_cast<const char*>(properties.name), properties.major, properties.minor));
  }
  return CudaDeviceInfo{properties.name, properties.major, properties.minor, all_bytes, free_bytes};
}

Expected<std::unique_ptr<Backend>> make_cuda_backend(const CudaOptions& options) {
  if (const auto device = cuda_device(options.device); !device) return fail(device.error());
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int threads = options.threads > 0 ? options.threads : cores;
  try {
    return options.precision == Precision::single_precision ? gpu::make_single_cuda_backend(options, threads)
                                                            : gpu::make_double_cuda_backend(options, threads);
  } catch (const std::exception& failure) {
    return no_device(failure.what());
  }
}

}  // namespace hooke
