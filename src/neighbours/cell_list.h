// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"
#include "hooke/base/vec3.h"
#include "hooke/neighbours/cell_grid.h"
#include "hooke/neighbours/window_search.h"

namespace hooke {

/// Points in the order of their cells (the thesis's Algorithm 3), and a search for the points in a box. Each level of
/// size has its own grid: the points of a level are consecutive, and a large particle does not enlarge the cells of
/// small particles.
///
/// A directory with at most a few entries per point holds the first point of each cell. In a domain of more cells than
/// that, an entry stands for several cells, and the cell is searched for among their points: a sparse cloud needs no
/// more memory than a dense one.
class CellList {
 public:
  /// Particles of similar size.
  struct Level {
    double largest_radius = 0;  ///< m
    double cell = 1;  ///< m, > 0: cells are at least this wide; half of it along rows
  };

  /// Lays grids over the box [min, max] (m, finite, min no greater than max), for up to `most_points` points; points
  /// outside count to the cells at its edge. A periodic axis must cover its whole period.
  void lay_out(const Vec3d& min, const Vec3d& max, const bool (&periodic)[3], std::span<const Level> levels,
               std::size_t most_points);

  /// Number of the cell of a finite point of a level.
  std::uint64_t key_of(const Vec3d& x, std::size_t level) const {
    HOOKE_ASSERT(level < level_count(), level, level_count());
    return levels_[level].first_key + levels_[level].grid.path_key_of(x);
  }
  /// The key of points that take no part; they are sorted last.
  std::uint64_t key_end() const { return key_end_; }

  /// Sorts points 0 to count - 1, up to 2^32, by key_of_point(i), a key or key_end(), stably: then order[k] is the
  /// previous index of the k-th point. Works in `scratch` where that is aligned to 8 bytes and holds 24 bytes per
  /// point; else in its own memory.
  template <class KeyOfPoint>
  void sort(std::size_t count, const KeyOfPoint& key_of_point, std::vector<std::uint32_t>& order,
            std::span<std::byte> scratch = {}) {
    constexpr std::size_t kGrain = 1024;
    const Room room = make_room(count, scratch);
    parallel_ranges(count, kGrain, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) room.keys[i] = key_of_point(i);
    });
    sort_keys(room, order);
  }

  std::size_t level_count() const { return levels_.size(); }
  const CellGrid& grid(std::size_t level) const { return levels_[level].grid; }
  double largest_radius(std::size_t level) const { return levels_[level].largest_radius; }

  /// Number of sorted points that take part.
  std::size_t point_count() const { return levels_.empty() ? 0 : level_end(levels_.size() - 1); }
  /// One past the last sorted point of a level.
  std::size_t level_end(std::size_t level) const {
    return first_at(level + 1 < levels_.size() ? levels_[level + 1].first_key : key_end_);
  }

  /// Appends the points of a level in the cells that the box [min, max] meets, each once; also around a periodic axis.
  /// Returns their number.
  std::size_t find(std::size_t level, const Vec3d& min, const Vec3d& max, std::vector<SearchRange>& out) const;

  /// Calls body(k) for each sorted point k of any level whose surface may be nearer than `reach` (m) to `at`, and for
  /// some other points.
  template <class Body>
  void for_points_near(const Vec3d& at, double reach, const Body& body) const {
    // The directory is read for many ranges at once, so that waiting for one entry does not delay the next.
    std::array<SearchRange, 64> found;
    std::size_t count = 0;
    const auto visit = [&] {
      for (const SearchRange& range : std::span(found).first(count)) {
        for (std::uint32_t k = range.from; k < range.to; ++k) body(k);
      }
      count = 0;
    };
    for (std::size_t level = 0; level < level_count(); ++level) {
      const double most = reach + largest_radius(level);
      for_ranges(level, at - Vec3d{most, most, most}, at + Vec3d{most, most, most}, [&](const SearchRange& range) {
        if (count == found.size()) visit();
        found[count++] = range;
      });
    }
    visit();
  }

 private:
  static constexpr double kCellsAlongRow = 2;

  struct LevelGrid {
    CellGrid grid;
    double largest_radius;  // m
    std::uint64_t first_key;
  };
  struct KeyedPoint {
    std::uint64_t key;
    std::uint32_t index;
  };
  struct Room {
    std::span<std::uint64_t> keys;
    std::span<KeyedPoint> points;
  };

  Room make_room(std::size_t count, std::span<std::byte> scratch);
  void sort_keys(const Room& room, std::vector<std::uint32_t>& order);
  void sort_part(std::span<const KeyedPoint> points, std::size_t first_slot, std::uint32_t first_point,
                 std::span<std::uint32_t> starts, std::vector<KeyedPoint>& sorted) const;

  // Calls body(range) for the points of a level in the cells that the box meets; skips empty ranges.
  template <class Body>
  void for_ranges(std::size_t level, const Vec3d& min, const Vec3d& max, const Body& body) const {
    const LevelGrid& in = levels_[level];
    in.grid.for_path_ranges(min, max, [&](const CellGrid::KeyRange& cells) {
      const SearchRange range{first_at(in.first_key + cells.first), first_at(in.first_key + cells.last + 1)};
      if (range.from != range.to) body(range);
    });
  }

  // Index of the first sorted point with a key of at least `key`.
  std::uint32_t first_at(std::uint64_t key) const {
    const std::uint64_t slot = key >> slot_bits_;
    return slot_bits_ == 0 ? starts_[slot] : first_in_slot(slot, key);
  }
  std::uint32_t first_in_slot(std::uint64_t slot, std::uint64_t key) const;

  std::vector<LevelGrid> levels_;
  std::uint64_t key_end_ = 0;
  unsigned slot_bits_ = 0;  // an entry of the directory stands for 2^slot_bits_ keys
  std::vector<std::uint32_t> starts_;  // first point of each entry, and one past the last
  std::vector<std::uint64_t> keys_;  // of the sorted points; empty where each entry is one cell
  std::vector<std::uint64_t> own_room_;  // used where no scratch is given
};

}  // namespace hooke
