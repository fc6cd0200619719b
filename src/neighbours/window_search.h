// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "hooke/base/vec3.h"

namespace hooke {

// The search for the neighbours of a window of particles as seen from outside: plain data in, plain data out, so that
// the search itself can be compiled for several instruction sets. Nothing in this header and in what it includes may
// emit an inline function that the linker could share between them.

/// So many points that follow each other in cell order are a window; within it they may lie in memory in any order. 16
/// that follow each other in memory are a group.
inline constexpr std::size_t kWindow = 64;

/// A vector quantity of many points, a column a component.
template <class Real>
struct Columns {
  const Real* x = nullptr;
  const Real* y = nullptr;
  const Real* z = nullptr;
};

/// Who is whose neighbour. Columns are in cell order but for those by slot, where in memory a point lies; 16 numbers
/// after their last one can be read.
template <class Real>
struct NeighbourRule {
  Columns<Real> at;  // positions, m
  const Real* radius = nullptr;  // m; null where all are the same
  const std::uint32_t* rank = nullptr;  // unique, below 2^30: the order of a row
  const std::uint8_t* place = nullptr;  // which slot of its window a point lies in
  std::uint8_t* neighbour_count = nullptr;  // result, by slot: up to 255, the point itself included
  Real reach{};  // m; p is listed when nearer to i than this, and r_i + r_p where radii differ
  bool periodic[3]{};  // then the nearest image counts
  Vec3<Real> length{};  // m, of periodic axes
  bool list_self = false;  // whether a point may touch an image of its own
  std::uint32_t stride = 1;  // a point is listed as its slot times this
  std::uint32_t dummy = 0;  // likewise: fills short lanes
};

/// Points `from` to `to` - 1.
struct SearchRange {
  std::uint32_t from, to;
};

/// Some points of a window that lie close together, and where those lie that may be near them. Across a periodic axis
/// all of them are nearer than half its length to the block's middle, or it has one point, in its middle.
template <class Real>
struct SearchBlock {
  std::uint32_t last;  // one past its last point; the first one follows the block before
  std::uint32_t range_count;  // disjoint ranges, which follow those of the block before
  Vec3<Real> middle;  // m
};

/// The search for the neighbours of one window. With n for the most points that the ranges of one block hold, the
/// caller gives room for n + 1 rows a group, and n + 32 of everything else.
template <class Real>
struct WindowSearch {
  std::uint32_t first = 0, end = 0;  // its points
  const SearchBlock<Real>* blocks = nullptr;  // up to one a point
  const SearchRange* ranges = nullptr;
  // Asked for room for so many rows of 16 entries, group after group: the result, in ascending order of rank in each
  // lane.
  std::uint32_t* (*room_for_rows)(void* list, std::size_t rows) = nullptr;
  void* list = nullptr;
  // Room to work in.
  std::uint64_t* rows = nullptr;  // of keys
  std::size_t row_room = 0;       // of each group
  Real* x = nullptr;  // the points that may be near a block's, seen from its middle
  Real* y = nullptr;
  Real* z = nullptr;
  Real* square = nullptr;
  Real* radius = nullptr;
  std::uint64_t* keys = nullptr;  // rank and slot
  std::int32_t* near = nullptr;  // which of those are the neighbours of some points
  std::size_t near_room = 0;  // of each
};

/// Lists the neighbours of a window's points.
template <class Real>
using WindowSearchFunction = void (*)(const NeighbourRule<Real>&, const WindowSearch<Real>&);

}  // namespace hooke
