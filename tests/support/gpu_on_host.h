// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "hooke/backends/gpu/host_device.h"
#include "hooke/core/backend.h"

namespace hooke::test {

/// The back end of a GPU, whose kernels run in a loop on the host.
std::unique_ptr<Backend> make_gpu_on_host(Precision precision, int threads,
                                          gpu::ItemOrder order = gpu::ItemOrder::shuffled,
                                          std::shared_ptr<gpu::HostDevice::Use> use = {});

std::unique_ptr<Backend> make_single_gpu_on_host(int threads, gpu::HostDevice device);
std::unique_ptr<Backend> make_double_gpu_on_host(int threads, gpu::HostDevice device);

}  // namespace hooke::test
