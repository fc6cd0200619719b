// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/gpu/cuda_module.h"

extern "C" __attribute__((visibility("default"))) const char* hooke_cuda_version() { return HOOKE_VERSION; }

extern "C" __attribute__((visibility("default"))) void hooke_count_cuda_devices(hooke::Expected<int>& count) {
  count = hooke::cuda_device_count();
}

extern "C" __attribute__((visibility("default"))) void hooke_find_cuda_device(
    int index, hooke::Expected<hooke::CudaDeviceInfo>& device) {
  device = hooke::cuda_device(index);
}

extern "C" __attribute__((visibility("default"))) void hooke_make_cuda_backend(
    const hooke::CudaOptions& options, hooke::Expected<std::unique_ptr<hooke::Backend>>& backend) {
  backend = hooke::make_cuda_backend(options);
}
