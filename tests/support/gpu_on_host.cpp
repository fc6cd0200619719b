// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "support/gpu_on_host.h"

namespace hooke::test {

std::unique_ptr<Backend> make_gpu_on_host(Precision precision, int threads, gpu::ItemOrder order) {
  return precision == Precision::single_precision ? make_single_gpu_on_host(threads, order)
                                                  : make_double_gpu_on_host(threads, order);
}

}  // namespace hooke::test
