// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "hooke/base/parallel.h"
#include "hooke/base/vec3.h"
#include "hooke/neighbours/cell_grid.h"
#include "hooke/neighbours/group_search.h"

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

/// Which points the list is built over, sorted by cell.
struct SortedCells {
  std::span<const std::uint64_t> keys;  // ascending
  const CellGrid* grid = nullptr;
};

namespace detail {

// Cuts groups into blocks: points in up to three adjacent cells of a row share the search for who may be near them.
class BlockFinder {
 public:
  explicit BlockFinder(const SortedCells& cells) : keys_(cells.keys), grid_(*cells.grid) {}

  // The block of the points from `first` on, `end` at most. Returns the number of points that its ranges hold.
  std::size_t find(std::size_t first, std::size_t end, SearchBlock& block) {
    constexpr int kMore = 2;
    const std::uint64_t key = keys_[first];
    const std::uint64_t key_end = std::min(key + kMore, grid_.row_end(key));
    std::size_t last = first + 1;
    while (last < end && keys_[last] <= key_end) ++last;
    block.last = static_cast<std::uint32_t>(last);

    CellGrid::KeyRange ranges[SearchBlock::kMostRanges];
    const std::size_t range_count = grid_.neighbour_ranges(key, ranges, static_cast<int>(keys_[last - 1] - key));
    block.range_count = static_cast<std::uint32_t>(range_count);
    std::size_t points = 0;
    for (std::size_t r = 0; r < range_count; ++r) {
      block.from[r] = static_cast<std::uint32_t>(from_[r].seek(keys_, ranges[r].first));
      block.to[r] = static_cast<std::uint32_t>(to_[r].seek(keys_, ranges[r].last + 1));
      points += block.to[r] - block.from[r];
    }
    return points;
  }

 private:
  std::span<const std::uint64_t> keys_;
  const CellGrid& grid_;
  std::array<KeyCursor, SearchBlock::kMostRanges> from_, to_;
};

// What one thread searches with. Room grows and is kept.
template <class Real>
struct SearchRoom {
  std::vector<std::uint32_t> entries;  // of a segment
  std::vector<std::int32_t> ranks, index, found;
  std::vector<Real> x, y, z, radius;

  // For a group whose blocks' ranges hold `most` points, after `used` entries.
  void make(std::size_t used, std::size_t most) {
    const std::size_t rows = (most + 1) * NeighbourList::kLanes;
    if (used + rows > entries.size()) entries.resize(2 * (used + rows));
    if (most + 32 <= x.size()) return;
    const std::size_t columns = 2 * (most + 32);
    ranks.resize(columns * NeighbourList::kLanes);
    for (auto* column : {&index, &found}) column->resize(columns);
    for (auto* column : {&x, &y, &z, &radius}) column->resize(columns);
  }
};

}  // namespace detail

/// Builds `list` anew, over the points that `rule` has columns of.
template <class Real>
void build_neighbour_list(const SortedCells& cells, const NeighbourRule<Real>& rule,
                          GroupSearchFunction<Real> search_group, NeighbourList& list) {
  constexpr std::size_t kLanes = NeighbourList::kLanes;
  const std::size_t count = cells.keys.size();
  list.clear((count + NeighbourList::kSegment - 1) / NeighbourList::kSegment);

  parallel_ranges(list.segments.size(), 1, [&](std::size_t first_segment, std::size_t last_segment) {
    detail::BlockFinder finder(cells);
    detail::SearchRoom<Real> room;
    std::array<SearchBlock, kLanes> blocks;
    for (std::size_t s = first_segment; s < last_segment; ++s) {
      NeighbourList::Segment& segment = list.segments[s];
      std::size_t used = 0;
      for (std::size_t g = 0; g < NeighbourList::kGroups; ++g) {
        const std::size_t first = std::min(s * NeighbourList::kSegment + g * kLanes, count);
        const std::size_t end = std::min(first + kLanes, count);
        std::size_t most = 0, block_count = 0;
        for (std::size_t i = first; i < end; i = blocks[block_count++].last) {
          most = std::max(most, finder.find(i, end, blocks[block_count]));
        }
        room.make(used, most);
        const GroupSearch<Real> group{static_cast<std::uint32_t>(first),
                                      blocks.data(),
                                      block_count,
                                      room.entries.data() + used,
                                      room.ranks.data(),
                                      room.x.data(),
                                      room.y.data(),
                                      room.z.data(),
                                      room.radius.data(),
                                      room.index.data(),
                                      room.found.data()};
        const std::size_t rows = search_group(rule, group);
        used += rows * kLanes;
        segment.first_row[g + 1] = segment.first_row[g] + static_cast<std::uint32_t>(rows);
      }
      segment.entries = list.keep({room.entries.data(), used});
    }
  });
}

}  // namespace hooke
