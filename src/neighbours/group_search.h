// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "hooke/base/vec3.h"

namespace hooke {

// The search for the neighbours of 16 particles as seen from outside: plain data in, plain data out, so that the search
// itself can be compiled for several instruction sets. Nothing in this header and in what it includes may emit an
// inline function that the linker could share between them.

/// A vector quantity of many points, a column a component.
template <class Real>
struct Columns {
  const Real* x = nullptr;
  const Real* y = nullptr;
  const Real* z = nullptr;
};

/// Who is whose neighbour. Columns are in cell order, and 16 numbers after their last one can be read.
template <class Real>
struct NeighbourRule {
  Columns<Real> at;  // positions, m; where x is null, they are in records
  const Real* records = nullptr;  // eight numbers a point, the first three its position, m; aligned like a pack
  const Real* radius = nullptr;  // m; null where all are the same
  const std::uint32_t* rank = nullptr;  // unique, below 2^31 - 1: the order of a row
  Real reach{};  // m; p is listed when nearer to i than this, and r_i + r_p where radii differ
  bool periodic[3]{};  // then the nearest image counts
  Vec3<Real> length{};  // m, of periodic axes
  bool list_self = false;  // whether a point may touch an image of its own
  std::uint32_t stride = 1;  // point i is listed as i times this
  std::uint32_t dummy = 0;  // fills short lanes
};

/// Some points of a group that lie close together, and where those lie that may be near them.
struct SearchBlock {
  static constexpr std::size_t kMostRanges = 50;
  std::uint32_t last;  // one past its last point; the first one follows the block before
  std::uint32_t range_count;
  std::uint32_t from[kMostRanges], to[kMostRanges];  // points from[r] to to[r] - 1; disjoint
};

/// The search for the neighbours of one group of consecutive points. With n for the most points that the ranges of one
/// block hold, the caller gives room for 16 (n + 1) entries and ranks, and for n + 32 of everything else.
template <class Real>
struct GroupSearch {
  std::uint32_t first = 0;
  const SearchBlock* blocks = nullptr;  // up to 16, the last one ends the group
  std::size_t block_count = 0;
  std::uint32_t* entries = nullptr;  // result: rows of 16, in ascending order of rank in each lane
  // Room to work in.
  std::int32_t* ranks = nullptr;  // of the entries
  Real* x = nullptr;  // the points that may be near a block's
  Real* y = nullptr;
  Real* z = nullptr;
  Real* radius = nullptr;
  std::int32_t* index = nullptr;
  std::int32_t* found = nullptr;  // neighbours of one point
};

/// Lists a group's neighbours; returns the number of rows.
template <class Real>
using GroupSearchFunction = std::size_t (*)(const NeighbourRule<Real>&, const GroupSearch<Real>&);

}  // namespace hooke
