// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "hooke/neighbours/reference_frame.h"
#include "hooke/neighbours/window_search.h"
#include "hooke/passes/exact_parts.h"
#include "hooke/passes/force_pass.h"

namespace hooke {

// Interface of the force pass over tiles; rules of inclusion as in force_pass.h.

/// Where particles were when their neighbour list was built, and where they are expected now.
template <class Real>
struct ListMotion {
  Vec3Columns<Real> position_at_build;  // positions when the list was built, m
  const ReferenceFrame<Real>* frames = nullptr;  // one per window: where its particles are expected
  Real next_step{};  // steps since the reference frames were set, this pass's drift included
};

/// What every slice of a pass needs.
template <class Real>
struct TilePass {
  ForcePass<Real> forces;
  ListMotion<Real> motion;
};

/// The part of a pass that one thread does at a time: consecutive slices of 16 particles, their rows of the neighbour
/// list, and where to write the reports.
template <class Real>
struct TileWork {
  std::size_t first = 0;  // first particle
  std::size_t slice_count = 0;
  bool alone = false;  // no particle touches others: there are no rows, and no particle is far
  const std::uint32_t* rows = nullptr;  // kRowsAhead rows after the last can be read
  const std::uint32_t* first_row = nullptr;  // slice_count + 1
  unsigned char* notes = nullptr;  // SliceNote bits, one entry a slice
  std::uint16_t* far =
      nullptr;  // one bit per particle, one entry per slice: further from its reference frame than allowed
  ExactParts* sums = nullptr;  // PassSum::kCount of them; the pass adds to them
};

template <class Real>
using ForcePassFunction = void (*)(const TilePass<Real>&, const TileWork<Real>&);

#define HOOKE_DECLARE_FORCE_PASS(isa)                                          \
  namespace isa {                                                              \
  void force_pass(const TilePass<float>& pass, const TileWork<float>& work);   \
  void force_pass(const TilePass<double>& pass, const TileWork<double>& work); \
  }
HOOKE_DECLARE_FORCE_PASS(scalar)
HOOKE_DECLARE_FORCE_PASS(portable)
HOOKE_DECLARE_FORCE_PASS(avx2)
HOOKE_DECLARE_FORCE_PASS(avx512)
#undef HOOKE_DECLARE_FORCE_PASS

}  // namespace hooke
