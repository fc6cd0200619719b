// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "hooke/backends/gpu/cuda_backend.h"
#include "hooke/base/expected.h"

// What the module hooke-cuda.so exports, for programs that load what needs CUDA only when a GPU is asked for. To be
// called only where hooke_cuda_version() is the caller's.

/// The version of Hooke that the module is of, e.g. "1.2.3".
extern "C" const char* hooke_cuda_version();
/// cuda_device_count() and cuda_device().
extern "C" void hooke_count_cuda_devices(hooke::Expected<int>& count);
extern "C" void hooke_find_cuda_device(int index, hooke::Expected<hooke::CudaDeviceInfo>& device);
/// make_cuda_backend().
extern "C" void hooke_make_cuda_backend(const hooke::CudaOptions& options,
                                        hooke::Expected<std::unique_ptr<hooke::Backend>>& backend);
