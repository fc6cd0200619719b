// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "hooke/physics/attraction.h"

namespace hooke {

// Interface of the sums of attraction: plain data in, plain data out, compiled for every instruction set like
// force_pass.h. Lengths and masses are in units that keep single precision inside its range (core/attraction.h).

/// A particle that pulls.
template <class Real>
struct AttractionSource {
  Real x, y, z, mass;
};

/// Many distant particles that pull together, as a cloud around their centre of mass.
template <class Real>
struct AttractionCell {
  Real x, y, z;
  MassCloud<Real> cloud;
};

/// The particles that are pulled, in whole packs, one column per component; and the sums.
template <class Real>
struct AttractionTargets {
  static constexpr std::size_t kMost = 64;
  alignas(64) Real x[kMost], y[kMost], z[kMost];
  alignas(64) Real ax[kMost], ay[kMost], az[kMost];
  alignas(64) Real potential[kMost];
  std::size_t count = 0;  // padded to a multiple of kFilling
  static constexpr std::size_t kFilling = 16;
};

/// Sources and targets. The pull of the sources is summed from 0 in their order, then added to the targets' sums.
template <class Real>
struct AttractionWork {
  AttractionTargets<Real>* targets = nullptr;
  const AttractionSource<Real>* sources = nullptr;
  std::size_t source_count = 0;
  const AttractionCell<Real>* cells = nullptr;
  std::size_t cell_count = 0;
  Real softening2{};
  bool exact = true;  // the same bits on every instruction set
};

/// One instruction set's sums.
template <class Real>
struct AttractionLoops {
  using Function = void (*)(const AttractionWork<Real>&);
  Function pull_by_particles;
  Function pull_by_cells;
  Function potential_of_particles;  // always exact; a source exactly at a target's position adds 0
  Function potential_of_cells;
};

#define HOOKE_DECLARE_ATTRACTION(isa)                              \
  namespace isa {                                                  \
  void pull_by_particles(const AttractionWork<float>& work);       \
  void pull_by_particles(const AttractionWork<double>& work);      \
  void pull_by_cells(const AttractionWork<float>& work);           \
  void pull_by_cells(const AttractionWork<double>& work);          \
  void potential_of_particles(const AttractionWork<float>& work);  \
  void potential_of_particles(const AttractionWork<double>& work); \
  void potential_of_cells(const AttractionWork<float>& work);      \
  void potential_of_cells(const AttractionWork<double>& work);     \
  }
HOOKE_DECLARE_ATTRACTION(scalar)
HOOKE_DECLARE_ATTRACTION(portable)
HOOKE_DECLARE_ATTRACTION(avx2)
HOOKE_DECLARE_ATTRACTION(avx512)
#undef HOOKE_DECLARE_ATTRACTION

}  // namespace hooke
