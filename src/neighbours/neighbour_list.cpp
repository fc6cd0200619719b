// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/neighbours/neighbour_list.h"

#include <algorithm>

#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"
#include "hooke/base/vec3.h"

namespace hooke {
namespace {

// The search of one thread.
template <class Real>
class WindowSearcher {
 public:
  // Finds the neighbours given by `rule` of points in the order of `cells`.
  WindowSearcher(const CellList& cells, const GhostPoints& ghosts, const NeighbourRule<Real>& rule,
                 WindowSearchFunction<Real> search)
      : cells_(cells),
        ghosts_(ghosts),
        rule_(rule),
        search_(search) {
    for (std::size_t level = 0; level < cells.level_count(); ++level) {
      levels_.push_back({cells.level_end(level), largest_block(level), {}});
      for (std::size_t other = 0; other < cells.level_count(); ++other) {
        levels_.back().reach.push_back(reach(level, other));
      }
    }
  }

  // Writes the rows of a window: the points first to end - 1.
  void write_rows(std::size_t first, std::size_t end, NeighbourList::Writer& writer) {
    HOOKE_ASSERT(first < end && end - first <= kWindow && end <= cells_.point_count(), first, end,
                 cells_.point_count());
    ranges_.clear();
    std::size_t most = 0, block_count = 0;
    for (std::size_t i = first; i < end; i = blocks_[block_count++].last) {
      most = std::max(most, find_block(i, end, blocks_[block_count]));
    }
    make_room(most);
    WindowSearch<Real> window;
    window.first = static_cast<std::uint32_t>(first);
    window.end = static_cast<std::uint32_t>(end);
    window.blocks = blocks_.data();
    window.ranges = ranges_.data();
    window.list = &writer;
    window.room_for_rows = [](void* to, std::size_t rows) {
      return static_cast<NeighbourList::Writer*>(to)->next_slice(rows);
    };
    window.rows = rows_.data();
    window.row_room = most + 1;
    window.x = x_.data();
    window.y = y_.data();
    window.z = z_.data();
    window.square = square_.data();
    window.radius = radius_.data();
    window.keys = keys_.data();
    window.near = near_.data();
    window.near_room = near_.size() / 4;
    search_(rule_, window);
  }

 private:
  struct Level {
    std::size_t end;  // one past its last point
    Vec3<Real> block;  // m: largest size of its blocks
    std::vector<double> reach;  // m: largest distance of its neighbours, by their level
  };

  // Selects the points from `first` on, before `end`, that lie close together, and finds the ranges to compare them
  // with. Returns the number of points in these ranges.
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
      const Box3d around{vec_cast<double>(min) - reach, vec_cast<double>(max) + reach};
      points += cells_.find(other, around.min, around.max, ranges_);
      if (ghosts_.cells == nullptr || (ghosts_.without.contains(around.min) && ghosts_.without.contains(around.max)))
        continue;
      const std::size_t first_range = ranges_.size();
      points += ghosts_.cells->find(other, around.min, around.max, ranges_);
      for (std::size_t k = first_range; k < ranges_.size(); ++k) {
        ranges_[k].from += static_cast<std::uint32_t>(ghosts_.first);
        ranges_[k].to += static_cast<std::uint32_t>(ghosts_.first);
      }
    }
    block.range_count = static_cast<std::uint32_t>(ranges_.size() - before);
    return points;
  }

  // The largest distance of neighbours from two levels, m; a millionth more for rounding.
  double reach(std::size_t a, std::size_t b) const {
    const double radii = rule_.radius == nullptr ? 0 : cells_.largest_radius(a) + cells_.largest_radius(b);
    return (static_cast<double>(rule_.reach) + radii) * (1 + 1e-6);
  }

  // The largest size of a level's blocks, m: long enough that many points share a search; across a periodic axis small
  // enough that only one image of a point can be near.
  Vec3<Real> largest_block(std::size_t level) const {
    constexpr double kLong = 3;  // cells
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

  // Makes room for a window whose blocks' ranges hold `most` points.
  void make_room(std::size_t most) {
    if (most + 32 <= x_.size()) return;
    const std::size_t room = 2 * (most + 32);
    rows_.resize(room * kWindow);
    keys_.resize(room);
    near_.resize(4 * room);
    for (auto* column : {&x_, &y_, &z_, &square_, &radius_}) column->resize(room);
  }

  const CellList& cells_;
  const GhostPoints& ghosts_;
  const NeighbourRule<Real>& rule_;
  const WindowSearchFunction<Real> search_;
  std::vector<Level> levels_;
  std::array<SearchBlock<Real>, kWindow> blocks_;
  std::vector<SearchRange> ranges_;
  std::vector<std::uint64_t> rows_, keys_;
  std::vector<std::int32_t> near_;
  std::vector<Real> x_, y_, z_, square_, radius_;
};

}  // namespace

std::size_t NeighbourList::entry_count() const {
  std::size_t n = 0;
  for (const Tile& s : tiles) n += std::size_t{s.first_row[kSlices]} * kLanes;
  return n;
}

void NeighbourList::clear(std::size_t tile_count) {
  tiles.assign(tile_count, Tile{});
  blocks_in_use_ = 0;
  begun_.clear();
}

// Memory for at least `entries` entries: the rest of a block where one is large enough. Any thread may call.
std::span<std::uint32_t> NeighbourList::new_block(std::size_t entries) {
  constexpr std::size_t kBehind = kRowsAhead * kLanes;
  const std::lock_guard lock(mutex_);
  const auto rest = std::find_if(begun_.begin(), begun_.end(), [&](const auto& left) {
    return left.size() >= std::max(entries, kBlock / 2);  // a tile that starts in little room must move soon
  });
  if (rest != begun_.end()) {
    const std::span<std::uint32_t> found = *rest;
    begun_.erase(rest);
    return found;
  }
  if (blocks_in_use_ == blocks_.size()) blocks_.emplace_back();
  LargeVector<std::uint32_t>& block = blocks_[blocks_in_use_++];
  if (block.size() < entries + kBehind) block.resize(std::max(kBlock, entries + kBehind));
  return std::span(block).first(block.size() - kBehind);
}

// The rest of an earlier writer's block; empty if there is none.
std::span<std::uint32_t> NeighbourList::begun_block() {
  const std::lock_guard lock(mutex_);
  if (begun_.empty()) return {};
  const std::span<std::uint32_t> block = begun_.back();
  begun_.pop_back();
  return block;
}

void NeighbourList::put_back(std::span<std::uint32_t> rest) {
  const std::lock_guard lock(mutex_);
  if (!rest.empty()) begun_.push_back(rest);
}

std::uint32_t* NeighbourList::Writer::next_slice(std::size_t rows) {
  HOOKE_ASSERT(slice_ < kSlices, slice_);
  const std::size_t entries = rows * kLanes;
  if (to_.size() < entries) {
    // The tile moves to where it has twice the room that it takes now, so that one of many rows moves a few times only,
    // and leaves its place to others.
    const std::size_t written = static_cast<std::size_t>(to_.data() - tile_);
    const std::span<std::uint32_t> block = list_.new_block(written > 0 ? 2 * written + entries : entries);
    std::copy_n(tile_, written, block.data());
    if (written + to_.size() >= kBlock / 2) list_.put_back({tile_, written + to_.size()});
    to_ = block.subspan(written);
    tile_ = block.data();
  }
  std::uint32_t* const room = to_.data();
  to_ = to_.subspan(entries);
  first_row_[slice_ + 1] = first_row_[slice_] + static_cast<std::uint32_t>(rows);
  ++slice_;
  return room;
}

NeighbourList::Tile NeighbourList::Writer::finish_tile() {
  std::fill(first_row_.begin() + static_cast<std::ptrdiff_t>(slice_), first_row_.end(), first_row_[slice_]);
  slice_ = 0;
  Tile tile;
  if (first_row_.back() > 0) tile.entries = tile_;
  tile.first_row = first_row_;
  tile_ = to_.data();
  return tile;
}

template <class Real>
void build_neighbour_list(const CellList& cells, const NeighbourRule<Real>& rule,
                          WindowSearchFunction<Real> search_window, NeighbourList& list, const GhostPoints& ghosts) {
  HOOKE_ASSERT(search_window != nullptr);
  HOOKE_ASSERT(
      cells.point_count() == 0 || (rule.at.x != nullptr && rule.id_index != nullptr && rule.slot_in_window != nullptr),
      cells.point_count());
  const std::size_t count = cells.point_count();
  list.clear((count + NeighbourList::kTile - 1) / NeighbourList::kTile);

  parallel_ranges(list.tiles.size(), 1, [&](std::size_t first_tile, std::size_t last_tile) {
    WindowSearcher<Real> searcher(cells, ghosts, rule, search_window);
    NeighbourList::Writer writer(list);
    for (std::size_t s = first_tile; s < last_tile; ++s) {
      const std::size_t end = std::min((s + 1) * NeighbourList::kTile, count);
      for (std::size_t first = s * NeighbourList::kTile; first < end; first += kWindow) {
        searcher.write_rows(first, std::min(first + kWindow, end), writer);
      }
      list.tiles[s] = writer.finish_tile();
    }
  });
}

template void build_neighbour_list(const CellList& cells, const NeighbourRule<float>& rule,
                                   WindowSearchFunction<float> search_window, NeighbourList& list,
                                   const GhostPoints& ghosts);
template void build_neighbour_list(const CellList& cells, const NeighbourRule<double>& rule,
                                   WindowSearchFunction<double> search_window, NeighbourList& list,
                                   const GhostPoints& ghosts);

}  // namespace hooke
