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

  /// The rows of group g of segment s.
  std::span<const std::uint32_t> rows(std::size_t s, std::size_t g) const {
    const Segment& segment = segments[s];
    const std::uint32_t first = segment.first_row[g];
    return {segment.entries + std::size_t{first} * kLanes, (segment.first_row[g + 1] - first) * kLanes};
  }

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
  BlockFinder(const SortedCells& cells, int around) : keys_(cells.keys), grid_(*cells.grid), around_(around) {}

  // The block of the points from `first` on, `end` at most. Returns the number of points that its ranges hold.
  std::size_t find(std::size_t first, std::size_t end, SearchBlock& block) {
    constexpr int kMore = 2;
    const std::uint64_t key = keys_[first];
    const std::uint64_t key_end = std::min(key + kMore, grid_.row_end(key));
    std::size_t last = first + 1;
    while (last < end && keys_[last] <= key_end) ++last;
    block.last = static_cast<std::uint32_t>(last);

    static_assert(SearchBlock::kMostRanges == CellGrid::kMostRanges);
    CellGrid::KeyRange ranges[CellGrid::kMostRanges];
    const std::size_t range_count =
        grid_.neighbour_ranges(key, ranges, static_cast<int>(keys_[last - 1] - key), around_);
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
  int around_;
  std::array<KeyCursor, SearchBlock::kMostRanges> from_, to_;
};

}  // namespace detail

/// What one thread searches with. Room grows and is kept.
template <class Real>
class GroupSearcher {
 public:
  /// Looks in the cells up to `around` away.
  GroupSearcher(const SortedCells& cells, const NeighbourRule<Real>& rule, GroupSearchFunction<Real> search, int around)
      : rule_(rule),
        search_(search),
        finder_(cells, around) {}

  /// Adds the rows of the points first to end - 1, at most 16, to the entries; returns their number.
  std::size_t add(std::size_t first, std::size_t end) {
    std::size_t most = 0, block_count = 0;
    for (std::size_t i = first; i < end; i = blocks_[block_count++].last) {
      most = std::max(most, finder_.find(i, end, blocks_[block_count]));
    }
    make_room(most);
    const GroupSearch<Real> group{static_cast<std::uint32_t>(first),
                                  blocks_.data(),
                                  block_count,
                                  entries_.data() + used_,
                                  ranks_.data(),
                                  x_.data(),
                                  y_.data(),
                                  z_.data(),
                                  radius_.data(),
                                  index_.data(),
                                  found_.data()};
    const std::size_t rows = search_(rule_, group);
    used_ += rows * NeighbourList::kLanes;
    return rows;
  }

  std::span<const std::uint32_t> entries() const { return {entries_.data(), used_}; }
  void clear() { used_ = 0; }

 private:
  // For a group whose blocks' ranges hold `most` points.
  void make_room(std::size_t most) {
    const std::size_t rows = (most + 1) * NeighbourList::kLanes;
    if (used_ + rows > entries_.size()) entries_.resize(2 * (used_ + rows));
    if (most + 32 <= x_.size()) return;
    const std::size_t room = 2 * (most + 32);
    ranks_.resize(room * NeighbourList::kLanes);
    for (auto* column : {&index_, &found_}) column->resize(room);
    for (auto* column : {&x_, &y_, &z_, &radius_}) column->resize(room);
  }

  const NeighbourRule<Real>& rule_;
  GroupSearchFunction<Real> search_;
  detail::BlockFinder finder_;
  std::array<SearchBlock, NeighbourList::kLanes> blocks_;
  std::vector<std::uint32_t> entries_;
  std::size_t used_ = 0;
  std::vector<std::int32_t> ranks_, index_, found_;
  std::vector<Real> x_, y_, z_, radius_;
};

/// Builds `list` anew, over the points that `rule` has columns of.
template <class Real>
void build_neighbour_list(const SortedCells& cells, const NeighbourRule<Real>& rule,
                          GroupSearchFunction<Real> search_group, NeighbourList& list) {
  constexpr std::size_t kLanes = NeighbourList::kLanes;
  const std::size_t count = cells.keys.size();
  list.clear((count + NeighbourList::kSegment - 1) / NeighbourList::kSegment);

  parallel_ranges(list.segments.size(), 1, [&](std::size_t first_segment, std::size_t last_segment) {
    GroupSearcher<Real> searcher(cells, rule, search_group, 1);
    for (std::size_t s = first_segment; s < last_segment; ++s) {
      NeighbourList::Segment& segment = list.segments[s];
      searcher.clear();
      for (std::size_t g = 0; g < NeighbourList::kGroups; ++g) {
        const std::size_t first = std::min(s * NeighbourList::kSegment + g * kLanes, count);
        const std::size_t rows = searcher.add(first, std::min(first + kLanes, count));
        segment.first_row[g + 1] = segment.first_row[g] + static_cast<std::uint32_t>(rows);
      }
      segment.entries = list.keep(searcher.entries());
    }
  });
}

}  // namespace hooke
