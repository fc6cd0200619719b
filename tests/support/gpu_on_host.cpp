// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "support/gpu_on_host.h"

#include <utility>

namespace hooke::test {

std::unique_ptr<Backend> make_gpu_on_host(Precision precision, int threads, gpu::ItemOrder order,
                                          std::shared_ptr<gpu::HostDevice::Use> use) {
  gpu::HostDevice device = use ? gpu::HostDevice(order, std::move(use)) : gpu::HostDevice(order);
  return precision == Precision::single_precision ? make_single_gpu_on_host(threads, std::move(device))
                                                  : make_double_gpu_on_host(threads, std::move(device));
}

}  // namespace hooke::test
