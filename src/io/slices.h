// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>

#include "hooke/base/assert.h"
#include "hooke/core/particle_slices.h"
#include "hooke/io/failure.h"

namespace hooke::io {

/// Calls `write`, which may throw, with slices of `rows` particles until it throws. What it has thrown is thrown again
/// when all have been handed over: where several ranks hand over theirs, none of them waits for another.
template <class Write>
void visit_slices(const ParticleSlices& particles, std::size_t rows, Write&& write) {
  std::exception_ptr thrown;
  std::uint64_t count = 0;
  Expected<void> visited = particles.visit(rows, [&](const ParticleSlice& slice) {
    count += slice.size();
    if (thrown) return;
    try {
      write(slice);
    } catch (...) {
      thrown = std::current_exception();
    }
  });
  if (thrown) std::rethrow_exception(thrown);
  take(std::move(visited));
  HOOKE_ASSERT(count == particles.size(), count, particles.size());
}

/// x, y and z of each of these one after the other; null where there are none.
inline const double* components(std::span<const Vec3d> vectors) {
  static_assert(sizeof(Vec3d) == 3 * sizeof(double));
  return vectors.empty() ? nullptr : &vectors.front().x;
}

}  // namespace hooke::io
