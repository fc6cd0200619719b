// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "hooke/backends/gpu/warp.h"
#include "hooke/passes/force_pass.h"

namespace hooke::gpu {

/// Where particles lie, for the forces on them.
template <class Real>
struct ParticlesView {
  const ParticleRecord<Real>* records = nullptr;
  const std::uint32_t* slot_of_id_index = nullptr;
  const std::uint64_t* ids = nullptr;  // by id index
  std::uint32_t id_count = 0;          // id indices
  std::uint32_t count = 0;             // particles
  std::uint32_t end = 0;               // one past the last slot in use
  std::uint32_t room = 0;              // slots; the last is the filler

  std::uint32_t whole_end() const { return (end + kWarp - 1) / kWarp * kWarp; }
  std::uint32_t filler() const { return record_offset<Real>(room - 1); }
};

}  // namespace hooke::gpu
