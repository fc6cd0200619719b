// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "hooke/base/parallel.h"
#include "hooke/base/vec3.h"
#include "hooke/neighbours/cell_grid.h"

namespace hooke {

/// A full neighbour list in lanes: 16 consecutive particles form a group, and row k of a group holds the k-th neighbour
/// of each of them, one a lane (the sliced-ELLPACK layout: Kreutzer et al., "A unified sparse matrix data format", SIAM
/// J. Sci. Comput. 2014). Each lane's neighbours are in ascending order of rank, so a force pass that adds row after
/// row sums in canonical order. Short lanes are filled up with a dummy. An entry is whatever the caller's `entry` makes
/// of a particle's index, e.g. an address offset.
class NeighbourList {
 public:
  static constexpr std::size_t kLanes = 16;
  static constexpr std::size_t kGroups = 64;  // groups a segment
  static constexpr std::size_t kSegment = kLanes * kGroups;

  /// The rows of 1024 consecutive particles: what one thread builds and later walks over.
  struct Segment {
    const std::uint32_t* entries = nullptr;  // rows of kLanes
    std::array<std::uint32_t, kGroups + 1> first_row{};  // group g: rows first_row[g] to first_row[g + 1]
  };
  std::vector<Segment> segments;

  /// Entries in use, padding included.
  std::size_t entry_count() const {
    std::size_t n = 0;
    for (const Segment& s : segments) n += std::size_t{s.first_row[kGroups]} * kLanes;
    return n;
  }

  /// Forgets all rows; their memory is kept for the next ones.
  void clear(std::size_t segment_count) {
    segments.assign(segment_count, Segment{});
    blocks_in_use_ = 0;
    used_ = 0;
  }

  /// A copy of `entries` that lives until clear(). Any thread may call.
  const std::uint32_t* keep(std::span<const std::uint32_t> entries) {
    const std::lock_guard lock(mutex_);
    if (blocks_in_use_ == 0 || used_ + entries.size() > blocks_[blocks_in_use_ - 1].size()) {
      // Segments are much smaller than a block, so little is left unused at its end.
      if (blocks_in_use_ == blocks_.size()) blocks_.emplace_back();
      std::vector<std::uint32_t>& block = blocks_[blocks_in_use_++];
      if (block.size() < entries.size()) block.resize(std::max(kBlock, entries.size()));
      used_ = 0;
    }
    std::uint32_t* to = blocks_[blocks_in_use_ - 1].data() + used_;
    std::copy(entries.begin(), entries.end(), to);
    used_ += entries.size();
    return to;
  }

 private:
  static constexpr std::size_t kBlock = std::size_t{1} << 18U;  // entries: 1 MiB

  std::mutex mutex_;
  std::vector<std::vector<std::uint32_t>> blocks_;
  std::size_t blocks_in_use_ = 0;
  std::size_t used_ = 0;  // of the last block in use
};

/// Which points the list is built over, sorted by cell, and how near is near enough.
template <class Real>
struct NeighbourSearch {
  std::size_t count = 0;
  std::span<const std::uint64_t> keys;  // ascending, of `count` points
  const CellGrid* grid = nullptr;
  Real skin{};  // m; a pair is listed when nearer than r_i + r_p + skin
  bool periodic[3]{};  // then the nearest image counts
  Vec3<Real> length{};  // m, of periodic axes
  bool list_self = false;  // whether a particle may touch an image of its own
  std::uint32_t dummy = 0;  // entry that fills short lanes
};

namespace detail {

// Columns that grow together and keep their room. Plain arrays: the loops over them vectorise.
template <class Real>
struct Candidates {
  std::vector<Real> x, y, z, reach;  // reach: radius + skin, m
  std::vector<std::int32_t> rank, index;  // below 2^31
  std::vector<std::int32_t> near;  // 1 where the candidate is a neighbour of the particle in hand, else 0
  std::size_t count = 0;

  void make_room(std::size_t more) {
    if (count + more <= x.size()) return;
    const std::size_t room = 2 * (count + more) + 64;
    x.resize(room);
    y.resize(room);
    z.resize(room);
    reach.resize(room);
    rank.resize(room);
    index.resize(room);
    near.resize(room);
  }
};

// One particle's neighbours.
struct Row {
  std::vector<std::int32_t> rank, index, sorted;
  std::size_t count = 0;

  void make_room(std::size_t room) {
    if (room <= rank.size()) return;
    rank.resize(2 * room);
    index.resize(2 * room);
    sorted.resize(2 * room);
  }

  // sorted[0 .. count): the indices in ascending order of rank. For the usual dozen each goes straight to its place,
  // the number of smaller ranks, which the compiler counts in SIMD and without a branch.
  void sort_by_rank() {
    constexpr std::size_t kCountingLimit = 64;
    if (count <= kCountingLimit) {
      std::int32_t place[kCountingLimit];
      std::fill(place, place + count, 0);
      for (std::size_t other = 0; other < count; ++other) {
        const std::int32_t other_rank = rank[other];
        for (std::size_t k = 0; k < count; ++k) place[k] += other_rank < rank[k] ? 1 : 0;
      }
      for (std::size_t k = 0; k < count; ++k) sorted[static_cast<std::size_t>(place[k])] = index[k];
      return;
    }
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs(count);
    for (std::size_t k = 0; k < count; ++k) pairs[k] = {rank[k], index[k]};
    std::sort(pairs.begin(), pairs.end());
    for (std::size_t k = 0; k < count; ++k) sorted[k] = pairs[k].second;
  }
};

// What one thread builds rows with.
template <class Real, class Points>
class RowBuilder {
 public:
  RowBuilder(const NeighbourSearch<Real>& search, const Points& points) : search_(search), points_(points) {}

  // Neighbours of point i, by rank. Points of one cell come after each other and share their candidates.
  void fill(std::size_t i, Row& row) {
    if (search_.keys[i] != key_) gather(search_.keys[i]);
    const bool any_periodic = search_.periodic[0] || search_.periodic[1] || search_.periodic[2];
    any_periodic ? mark_near<true>(i) : mark_near<false>(i);

    row.make_room(near_.count + 1);
    std::int32_t* __restrict__ rank = row.rank.data();
    std::int32_t* __restrict__ index = row.index.data();
    std::size_t kept = 0;
    for (std::size_t c = 0; c < near_.count; ++c) {  // every candidate is written, the next one over it if it is far
      rank[kept] = near_.rank[c];
      index[kept] = near_.index[c];
      kept += static_cast<std::size_t>(near_.near[c]);
    }
    row.count = kept;
    row.sort_by_rank();
  }

 private:
  void gather(std::uint64_t key) {
    key_ = key;
    near_.count = 0;
    CellGrid::KeyRange ranges[18];
    const std::size_t range_count = search_.grid->neighbour_ranges(key, ranges);
    for (std::size_t r = 0; r < range_count; ++r) {
      const std::size_t first = cursors_[r].seek(search_.keys, ranges[r].first);
      std::size_t last = first;
      while (last < search_.count && search_.keys[last] <= ranges[r].last) ++last;
      near_.make_room(last - first);
      std::size_t c = near_.count;
      for (std::size_t p = first; p < last; ++p, ++c) {
        const Vec3<Real> x = points_.position(p);
        near_.x[c] = x.x;
        near_.y[c] = x.y;
        near_.z[c] = x.z;
        near_.reach[c] = points_.radius(p) + search_.skin;
        near_.rank[c] = static_cast<std::int32_t>(points_.rank(p));
        near_.index[c] = static_cast<std::int32_t>(p);
      }
      near_.count = c;
    }
  }

  template <bool kPeriodic>
  void mark_near(std::size_t i) {
    const Vec3<Real> x = points_.position(i);
    const Real radius = points_.radius(i);
    const auto self = search_.list_self ? std::int32_t{-1} : static_cast<std::int32_t>(i);
    const auto displacement = [&](Real x_i, Real x_p, int axis) {
      const Real d = x_i - x_p;
      if (!kPeriodic || !search_.periodic[axis]) return d;
      const Real length = component(search_.length, axis);
      const Real half = Real(0.5) * length;
      return d > half ? d - length : d < -half ? d + length : d;
    };
    for (std::size_t c = 0; c < near_.count; ++c) {
      const Real dx = displacement(x.x, near_.x[c], 0);
      const Real dy = displacement(x.y, near_.y[c], 1);
      const Real dz = displacement(x.z, near_.z[c], 2);
      const Real reach = radius + near_.reach[c];
      near_.near[c] = (dx * dx + dy * dy + dz * dz < reach * reach ? 1 : 0) & (near_.index[c] != self ? 1 : 0);
    }
  }

  const NeighbourSearch<Real>& search_;
  const Points& points_;
  std::uint64_t key_ = ~std::uint64_t{0};
  Candidates<Real> near_;
  std::array<KeyCursor, 18> cursors_;
};

}  // namespace detail

/// Builds `list` anew. `points` gives position(i), radius(i) and rank(i) (unique, below 2^31) of the points in the
/// order of `search.keys`; `entry(i)` what the list stores for point i.
template <class Real, class Points, class Entry>
void build_neighbour_list(const NeighbourSearch<Real>& search, const Points& points, const Entry& entry,
                          NeighbourList& list) {
  constexpr std::size_t kLanes = NeighbourList::kLanes;
  list.clear((search.count + NeighbourList::kSegment - 1) / NeighbourList::kSegment);

  parallel_ranges(list.segments.size(), 1, [&](std::size_t first_segment, std::size_t last_segment) {
    detail::RowBuilder<Real, Points> builder(search, points);
    std::array<detail::Row, kLanes> lanes;
    std::vector<std::uint32_t> entries;
    for (std::size_t s = first_segment; s < last_segment; ++s) {
      NeighbourList::Segment& segment = list.segments[s];
      entries.clear();
      segment.first_row[0] = 0;
      for (std::size_t g = 0; g < NeighbourList::kGroups; ++g) {
        const std::size_t first = s * NeighbourList::kSegment + g * kLanes;
        std::size_t rows = 0;
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          lanes[lane].count = 0;
          if (first + lane < search.count) builder.fill(first + lane, lanes[lane]);
          rows = std::max(rows, lanes[lane].count);
        }
        const std::size_t start = entries.size();
        entries.resize(start + rows * kLanes, search.dummy);
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          std::uint32_t* to = entries.data() + start + lane;
          for (std::size_t k = 0; k < lanes[lane].count; ++k) {
            to[k * kLanes] = entry(static_cast<std::uint32_t>(lanes[lane].sorted[k]));
          }
        }
        segment.first_row[g + 1] = segment.first_row[g] + static_cast<std::uint32_t>(rows);
      }
      segment.entries = list.keep(entries);
    }
  });
}

}  // namespace hooke
