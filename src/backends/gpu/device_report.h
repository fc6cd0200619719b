// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hooke::gpu {

/// What the kernels of a step have noticed, for the host to read. All zeros before.
struct DeviceReport {
  std::uint32_t lost;      ///< not 0: the complement of the lowest id index of a particle at no finite place
  std::uint32_t stale;     ///< 1: particles that are not listed may touch
  std::uint32_t suspects;  ///< how many particles have a contact that may be too fast
  std::uint32_t departed;  ///< how many particles are outside an open face, or in a sink
  std::uint32_t found;     ///< how many particles a search by place has found
  std::uint32_t torn;      ///< how many springs tore
  std::uint32_t steps;     ///< how many steps in a row are done
  std::uint32_t halted;    ///< 1: the last of them needs the host; kernels of the steps after it do nothing
  std::uint32_t moved[6];  ///< ordered(): the largest displacements along x, y, z, -x, -y, -z
};

}  // namespace hooke::gpu
