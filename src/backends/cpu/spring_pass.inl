// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The spring pass over slices, compiled once for each instruction set (HOOKE_ISA).

#include "hooke/backends/cpu/packs.h"
// After the packs.
#include "hooke/passes/spring_pass.inl"

namespace hooke::HOOKE_ISA {
namespace {

template <class Real, bool kPeriodic>
void run_spring_slices(const SpringPass<Real>& pass, const SpringWork<Real>& work) {
  for (std::size_t slice = 0; slice < work.slice_count; ++slice) {
    unsigned torn = 0;
    for (std::size_t half = 0; half < kSliceLanes; half += Pack<Real>::kLanes) {
      run_spring_pack<Real, kPeriodic>(pass, work, slice, half, torn);
    }
    work.torn[slice] = static_cast<unsigned char>(torn);
  }
}

template <class Real>
void choose_spring_pass(const SpringPass<Real>& pass, const SpringWork<Real>& work) {
  if (pass.any_periodic) return run_spring_slices<Real, true>(pass, work);
  return run_spring_slices<Real, false>(pass, work);
}

}  // namespace

void spring_pass(const SpringPass<float>& pass, const SpringWork<float>& work) { choose_spring_pass(pass, work); }
void spring_pass(const SpringPass<double>& pass, const SpringWork<double>& work) { choose_spring_pass(pass, work); }

}  // namespace hooke::HOOKE_ISA
