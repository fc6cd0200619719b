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
  Columns<Real> at;  // positions, m
  const Real* radius = nullptr;  // m; null where all are the same
  const std::uint32_t* rank = nullptr;  // unique, below 2^30: the order of a row
  Real reach{};  // m; p is listed when nearer to i than this, and r_i + r_p where radii differ
  bool periodic[3]{};  // then the nearest image counts
  Vec3<Real> length{};  // m, of periodic axes
  bool list_self = false;  // whether a point may touch an image of its own
  std::uint32_t stride = 1;  // point i is listed as i times this
  std::uint32_t dummy = 0;  // likewise: fills short lanes
};

/// Points `from` to `to` - 1.
struct SearchRange {
  std::uint32_t from, to;
};

/// Some points of a group that lie close together, and where those lie that may be near them. Across a periodic axis
/// all of them are nearer than half its length to the block's middle, or it has one point, in its middle.
template <class Real>
struct SearchBlock {
  std::uint32_t last;  // one past its last point; the first one follows the block before
  std::uint32_t range_count;  // disjoint ranges, which follow those of the block before
  Vec3<Real> middle;  // m
};

/// The search for the neighbours of one group of consecutive points. With n for the most points that the ranges of one
/// block hold, the caller gives room for 16 (n + 1) entries and rows, and n + 32 of everything else.
template <class Real>
struct GroupSearch {
  std::uint32_t first = 0;
  const SearchBlock<Real>* blocks = nullptr;  // up to 16, the last one ends the group
  std::size_t block_count = 0;
  const SearchRange* ranges = nullptr;
  std::uint32_t* entries = nullptr;  // result: rows of 16, in ascending order of rank in each lane
  // Room to work in.
  std::uint64_t* rows = nullptr;  // of keys
  Real* x = nullptr;  // the points that may be near a block's, seen from its middle
  Real* y = nullptr;
  Real* z = nullptr;
  Real* square = nullptr;
  Real* radius = nullptr;
  std::uint64_t* keys = nullptr;  // rank and index
  std::int32_t* near = nullptr;  // which of those are the neighbours of some points
  std::size_t near_room = 0;  // of each
};

/// Lists a group's neighbours; returns the number of rows.
template <class Real>
using GroupSearchFunction = std::size_t (*)(const NeighbourRule<Real>&, const GroupSearch<Real>&);

}  // namespace hooke
