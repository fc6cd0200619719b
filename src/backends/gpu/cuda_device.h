// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cuda_runtime.h>

#include <cub/device/device_scan.cuh>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "hooke/backends/gpu/device.h"
#include "hooke/core/backend.h"

#if defined(__CUDA_FTZ) || defined(__USE_FAST_MATH__)
#error "All bits of a step are those of a processor: no -use_fast_math, no -ftz=true"
#endif

namespace hooke::gpu {

inline void check(cudaError_t result, const char* what) {
  if (result != cudaSuccess) throw DeviceFailure(std::string(what) + ": " + cudaGetErrorString(result));
}

// In constant memory: a function that takes the kernel's address would else copy it to every thread's stack.
template <int kThreads, class Kernel>
__global__ void __launch_bounds__(kThreads) run_items(const __grid_constant__ Kernel kernel, std::uint32_t count) {
  const std::uint32_t i = blockIdx.x * kThreads + threadIdx.x;
  if (i < count) kernel(i);
}

/// A GPU of the machine: an item is a thread.
class CudaDevice {
 public:
  /// `index`: as the CUDA runtime numbers devices; there must be one of this index.
  explicit CudaDevice(int index) : index_(index) {
    check(cudaSetDevice(index), "the GPU can't be used");
    cudaDeviceProp properties{};
    check(cudaGetDeviceProperties(&properties, index), "the GPU does not answer");
    name_ = properties.name;
    reads_the_hosts_pages_ = properties.pageableMemoryAccessUsesHostPageTables != 0;
    check(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking), "the GPU takes no work");
  }
  CudaDevice(CudaDevice&& other) noexcept
      : index_(other.index_),
        name_(std::move(other.name_)),
        reads_the_hosts_pages_(other.reads_the_hosts_pages_),
        stream_(std::exchange(other.stream_, nullptr)),
        scratch_(std::exchange(other.scratch_, nullptr)),
        scratch_bytes_(std::exchange(other.scratch_bytes_, 0)) {}
  CudaDevice& operator=(CudaDevice&&) = delete;
  ~CudaDevice() {
    if (scratch_ != nullptr) cudaFree(scratch_);
    if (stream_ != nullptr) cudaStreamDestroy(stream_);
  }

  template <class Kernel>
  void each(std::uint32_t count, const Kernel& kernel) const {
    constexpr int kThreads = 256;
    if (count == 0) return;
    use();
    run_items<kThreads><<<(count + kThreads - 1) / kThreads, kThreads, 0, stream_>>>(kernel, count);
    check(cudaGetLastError(), "the GPU can't run a kernel");
  }

  void scan(std::uint32_t* values, std::size_t count) {
    use();
    std::size_t bytes = 0;
    const auto items = static_cast<std::int64_t>(count);
    check(cub::DeviceScan::ExclusiveSum(nullptr, bytes, values, values, items, stream_), "a scan failed");
    if (bytes > scratch_bytes_) {
      if (scratch_ != nullptr) free(std::exchange(scratch_, nullptr));
      scratch_bytes_ = 0;
      scratch_ = allocate(2 * bytes);
      scratch_bytes_ = 2 * bytes;
    }
    check(cub::DeviceScan::ExclusiveSum(scratch_, bytes, values, values, items, stream_), "a scan failed");
  }

  void* allocate(std::size_t bytes) const {
    use();
    void* memory = nullptr;
    const cudaError_t result = cudaMalloc(&memory, bytes);
    if (result == cudaErrorMemoryAllocation) {
      cudaGetLastError();  // it is not lasting
      std::size_t free_bytes = 0, all_bytes = 0;
      cudaMemGetInfo(&free_bytes, &all_bytes);
      throw OutOfMemory("the GPU's memory does not suffice: " + std::to_string(free_bytes >> 20U) + " of " +
                        std::to_string(all_bytes >> 20U) + " MiB are free, and " + std::to_string(bytes >> 20U) +
                        " MiB more are needed");
    }
    check(result, "the GPU gives no memory");
    return memory;
  }
  void free(void* memory) const { cudaFree(memory); }  // waits for the work that may use it

  void fill(void* to, int byte, std::size_t bytes) const {
    use();
    check(cudaMemsetAsync(to, byte, bytes, stream_), "the GPU can't set memory");
  }
  void upload(void* to, const void* from, std::size_t bytes) const {
    use();
    check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice, stream_), "the GPU takes no data");
    // Else the data has been copied to where the GPU gets it from.
    if (reads_the_hosts_pages_) check(cudaStreamSynchronize(stream_), "the GPU failed");
  }
  void download(void* to, const void* from, std::size_t bytes) const {
    use();
    check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToHost, stream_), "the GPU gives no data");
    check(cudaStreamSynchronize(stream_), "the GPU failed");
  }
  void copy(void* to, const void* from, std::size_t bytes) const {
    use();
    check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToDevice, stream_), "the GPU can't copy");
  }

  const char* name() const { return name_.c_str(); }

 private:
  // Each thread of the host has a GPU of its own that it talks to.
  void use() const { check(cudaSetDevice(index_), "the GPU can't be used"); }

  int index_;
  std::string name_;
  bool reads_the_hosts_pages_ = false;
  cudaStream_t stream_ = nullptr;
  void* scratch_ = nullptr;
  std::size_t scratch_bytes_ = 0;
};

}  // namespace hooke::gpu
