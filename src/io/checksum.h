// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "hooke/core/particle_slices.h"
#include "hooke/core/scene.h"

namespace hooke::io {

// Checksums of what a file is to give back, for data whose way through the HDF5 library crosses tables that bear no
// checksums of their own.

/// Of a snapshot's step, time (s) and particles, without their accelerations, as a file of this precision stores them.
class SnapshotChecksum {
 public:
  SnapshotChecksum(std::int64_t step, double time, std::uint64_t particles, Precision precision);
  /// The next particles in ascending order of id.
  void add(const ParticleSlice& particles);
  std::uint64_t value() const { return sum_; }

 private:
  template <class Real>
  void add_as(const ParticleSlice& particles);

  Precision precision_;
  std::uint64_t sum_;
};

/// Of a text.
std::uint64_t checksum(std::string_view text);

}  // namespace hooke::io
