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

#include "hooke/base/huge_pages.h"
#include "hooke/base/parallel.h"
#include "hooke/base/vec3.h"
#include "hooke/neighbours/cell_list.h"
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

  /// The same, to be changed in place.
  std::span<std::uint32_t> rows_to_edit(std::size_t s, std::size_t g) {
    const std::span<const std::uint32_t> rows = this->rows(s, g);
    return {const_cast<std::uint32_t*>(rows.data()), rows.size()};  // NOLINT: the memory is this list's own
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
    begun_.clear();
  }

  /// Adds segments without rows until there are `segment_count`.
  void add_empty_segments(std::size_t segment_count) {
    static constexpr std::array<std::uint32_t, kLanes> kNoRow{};
    Segment empty;
    empty.entries = kNoRow.data();
    segments.resize(std::max(segments.size(), segment_count), empty);
  }

  /// Writes the rows of one segment after the other, straight to where they stay until clear(). One thread each.
  class Writer {
   public:
    explicit Writer(NeighbourList& list) : list_(list), to_(list.begun_block()) {}
    ~Writer() { list_.put_back(to_); }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    /// Room for so many more entries of the segment; what was written of it before may move.
    std::uint32_t* room(std::size_t entries) {
      if (to_.size() < entries) {
        const std::size_t written = static_cast<std::size_t>(to_.data() - segment_);
        const std::span<std::uint32_t> block = list_.new_block(written + entries);
        std::copy_n(segment_, written, block.data());
        to_ = block.subspan(written);
        segment_ = block.data();
      }
      return to_.data();
    }
    /// So many of them are filled.
    void add(std::size_t entries) { to_ = to_.subspan(entries); }
    /// Ends the segment; returns where it starts.
    const std::uint32_t* finish_segment() { return std::exchange(segment_, to_.data()); }

   private:
    NeighbourList& list_;
    std::span<std::uint32_t> to_;  // room that is left
    std::uint32_t* segment_ = to_.data();
  };

 private:
  static constexpr std::size_t kBlock = std::size_t{1} << 19U;  // entries: 2 MiB, a huge page

  // Memory for at least so many entries. Any thread may call.
  std::span<std::uint32_t> new_block(std::size_t entries) {
    const std::lock_guard lock(mutex_);
    if (blocks_in_use_ == blocks_.size()) blocks_.emplace_back();
    LargeVector<std::uint32_t>& block = blocks_[blocks_in_use_++];
    if (block.size() < entries) block.resize(std::max(kBlock, entries));
    return block;
  }

  // What an earlier writer left of a block; empty where none did.
  std::span<std::uint32_t> begun_block() {
    const std::lock_guard lock(mutex_);
    if (begun_.empty()) return {};
    const std::span<std::uint32_t> block = begun_.back();
    begun_.pop_back();
    return block;
  }
  void put_back(std::span<std::uint32_t> rest) {
    const std::lock_guard lock(mutex_);
    if (!rest.empty()) begun_.push_back(rest);
  }

  std::mutex mutex_;
  std::vector<LargeVector<std::uint32_t>> blocks_;
  std::size_t blocks_in_use_ = 0;
  std::vector<std::span<std::uint32_t>> begun_;
};

/// What one thread searches with.
template <class Real>
class GroupSearcher {
 public:
  /// Finds the neighbours that `rule` asks for, of points in the order of `cells`.
  GroupSearcher(const CellList& cells, const NeighbourRule<Real>& rule, GroupSearchFunction<Real> search)
      : cells_(cells),
        rule_(rule),
        search_(search) {
    for (std::size_t level = 0; level < cells.level_count(); ++level) {
      levels_.push_back({cells.level_end(level), largest_block(level), {}});
      for (std::size_t other = 0; other < cells.level_count(); ++other) {
        levels_.back().reach.push_back(reach(level, other));
      }
    }
  }

  /// Writes the rows of the points first to end - 1, at most 16, to room(n), where there has to be room for n entries;
  /// returns their number.
  template <class Room>
  std::size_t write_rows(std::size_t first, std::size_t end, const Room& room) {
    ranges_.clear();
    std::size_t most = 0, block_count = 0;
    for (std::size_t i = first; i < end; i = blocks_[block_count++].last) {
      most = std::max(most, find_block(i, end, blocks_[block_count]));
    }
    make_room(most);
    const GroupSearch<Real> group{static_cast<std::uint32_t>(first),
                                  blocks_.data(),
                                  block_count,
                                  ranges_.data(),
                                  room((most + 1) * NeighbourList::kLanes),
                                  rows_.data(),
                                  x_.data(),
                                  y_.data(),
                                  z_.data(),
                                  square_.data(),
                                  radius_.data(),
                                  keys_.data(),
                                  near_.data(),
                                  near_.size() / 4};
    return search_(rule_, group);
  }

 private:
  struct Level {
    std::size_t end;  // one past its last point
    Vec3<Real> block;  // m: its blocks are no larger
    std::vector<double> reach;  // m: its neighbours of each level are no further
  };

  // Cuts off the points from `first` on, before `end`, that lie close together, and finds the ranges that they are
  // compared with. Returns the number of points in those.
  std::size_t find_block(std::size_t first, std::size_t end, SearchBlock<Real>& block) {
    std::size_t l = 0;
    while (first >= levels_[l].end) ++l;
    const Level& level = levels_[l];
    end = std::min(end, level.end);
    Vec3<Real> min = position(first), max = min;
    std::size_t last = first + 1;
    for (; last < end; ++last) {
      const Vec3<Real> x = position(last);
      const Vec3<Real> low{std::min(min.x, x.x), std::min(min.y, x.y), std::min(min.z, x.z)};
      const Vec3<Real> high{std::max(max.x, x.x), std::max(max.y, x.y), std::max(max.z, x.z)};
      if (high.x - low.x > level.block.x || high.y - low.y > level.block.y || high.z - low.z > level.block.z) break;
      min = low;
      max = high;
    }
    block.last = static_cast<std::uint32_t>(last);
    block.middle = min;

    const std::size_t before = ranges_.size();
    std::size_t points = 0;
    for (std::size_t other = 0; other < levels_.size(); ++other) {
      const Vec3d reach{level.reach[other], level.reach[other], level.reach[other]};
      points += cells_.find(other, vec_cast<double>(min) - reach, vec_cast<double>(max) + reach, ranges_);
    }
    block.range_count = static_cast<std::uint32_t>(ranges_.size() - before);
    return points;
  }

  // How far neighbours of two levels may be from each other, m. A millionth more for rounding.
  double reach(std::size_t a, std::size_t b) const {
    const double radii = rule_.radius == nullptr ? 0 : cells_.largest_radius(a) + cells_.largest_radius(b);
    return (static_cast<double>(rule_.reach) + radii) * (1 + 1e-6);
  }

  // How large a block of a level may be, m: long enough that many points share a search; across a periodic axis so
  // small that whoever is near has one image only that is.
  Vec3<Real> largest_block(std::size_t level) const {
    constexpr double kLong = 5;  // cells
    const CellGrid& grid = cells_.grid(level);
    Vec3d most{grid.axis(0).cell, grid.axis(1).cell, grid.axis(2).cell};
    component(most, grid.path()[0]) = kLong * component(most, grid.path()[1]);
    for (int axis = 0; axis < 3; ++axis) {
      if (!rule_.periodic[axis]) continue;
      const double half = 0.499 * static_cast<double>(component(rule_.length, axis));
      component(most, axis) = std::min(component(most, axis), half - reach(level, cells_.level_count() - 1));
    }
    return vec_cast<Real>(most);
  }

  Vec3<Real> position(std::size_t i) const { return {rule_.at.x[i], rule_.at.y[i], rule_.at.z[i]}; }

  // For a group whose blocks' ranges hold `most` points.
  void make_room(std::size_t most) {
    if (most + 32 <= x_.size()) return;
    const std::size_t room = 2 * (most + 32);
    rows_.resize(room * NeighbourList::kLanes);
    keys_.resize(room);
    near_.resize(4 * room);
    for (auto* column : {&x_, &y_, &z_, &square_, &radius_}) column->resize(room);
  }

  const CellList& cells_;
  const NeighbourRule<Real>& rule_;
  const GroupSearchFunction<Real> search_;
  std::vector<Level> levels_;
  std::array<SearchBlock<Real>, NeighbourList::kLanes> blocks_;
  std::vector<SearchRange> ranges_;
  std::vector<std::uint64_t> rows_, keys_;
  std::vector<std::int32_t> near_;
  std::vector<Real> x_, y_, z_, square_, radius_;
};

/// Builds `list` anew, over the sorted points, of which `rule` has columns.
template <class Real>
void build_neighbour_list(const CellList& cells, const NeighbourRule<Real>& rule,
                          GroupSearchFunction<Real> search_group, NeighbourList& list) {
  constexpr std::size_t kLanes = NeighbourList::kLanes;
  const std::size_t count = cells.point_count();
  list.clear((count + NeighbourList::kSegment - 1) / NeighbourList::kSegment);

  parallel_ranges(list.segments.size(), 1, [&](std::size_t first_segment, std::size_t last_segment) {
    GroupSearcher<Real> searcher(cells, rule, search_group);
    NeighbourList::Writer writer(list);
    for (std::size_t s = first_segment; s < last_segment; ++s) {
      NeighbourList::Segment& segment = list.segments[s];
      for (std::size_t g = 0; g < NeighbourList::kGroups; ++g) {
        const std::size_t first = std::min(s * NeighbourList::kSegment + g * kLanes, count);
        const std::size_t rows = searcher.write_rows(first, std::min(first + kLanes, count),
                                                     [&](std::size_t most) { return writer.room(most); });
        writer.add(rows * kLanes);
        segment.first_row[g + 1] = segment.first_row[g] + static_cast<std::uint32_t>(rows);
      }
      segment.entries = writer.finish_segment();
    }
  });
}

}  // namespace hooke
