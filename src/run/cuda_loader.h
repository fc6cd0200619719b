// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "hooke/backends/gpu/cuda_backend.h"
#include "hooke/base/expected.h"
#include "hooke/core/backend.h"

namespace hooke::run {

// The functions of backends/gpu/cuda_backend.h, from hooke-cuda.so (module_loader.h). bad_input where the build has no
// such module.

Expected<int> count_cuda_devices();                                                  ///< cuda_device_count()
Expected<CudaDeviceInfo> find_cuda_device(int index);                                ///< cuda_device()
Expected<std::unique_ptr<Backend>> load_cuda_backend(const CudaOptions& options);  ///< make_cuda_backend()

}  // namespace hooke::run
