// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hooke/base/parallel.h"
#include "hooke/base/vec3.h"
#include "hooke/neighbours/cell_grid.h"

namespace hooke {

/// A full neighbour list in lanes: 16 consecutive particles form a group, and row k of a group holds the k-th neighbour
/// of each of them, one a lane (the sliced-ELLPACK layout: Kreutzer et al., "A unified sparse matrix data format", SIAM
/// J. Sci. Comput. 2014). Each lane's neighbours are in ascending order of rank, so a force pass that adds row after row
/// sums in canonical order. Short lanes are filled up with a dummy. An entry is whatever the caller's `entry` makes of a
/// particle's index, e.g. an address offset.
struct NeighbourList {
  static constexpr std::size_t kLanes = 16;
  static constexpr std::size_t kGroups = 64;  // groups a segment
  static constexpr std::size_t kSegment = kLanes * kGroups;

  /// The rows of 1024 consecutive particles: what one thread builds and later walks over.
  struct Segment {
    std::vector<std::uint32_t> entries;               // rows of kLanes
    std::array<std::uint32_t, kGroups + 1> first_row; // group g: rows first_row[g] to first_row[g + 1]
  };
  std::vector<Segment> segments;

  std::size_t entry_count() const {
    std::size_t n = 0;
    for (const Segment& s : segments) n += s.entries.size();
    return n;
  }
};

/// Which points the list is built over, sorted by cell, and how near is near enough.
template <class Real>
struct NeighbourSearch {
  std::size_t count = 0;
  std::span<const std::uint64_t> keys;  // ascending, of `count` points
  const CellGrid* grid = nullptr;
  Real skin{};                // m; a pair is listed when nearer than r_i + r_p + skin
  bool periodic[3]{};         // then the nearest image counts
  Vec3<Real> length{};        // m, of periodic axes
  bool list_self = false;     // whether a particle may touch an image of its own
  std::uint32_t dummy = 0;    // entry that fills short lanes
};

namespace detail {

// The points near one cell, copied together: what the particles of that cell choose from.
template <class Real>
struct Candidates {
  std::vector<Real> x, y, z, reach;      // reach: radius + skin
  std::vector<std::uint64_t> rank_index; // rank in the upper half, index in the lower

  void clear() {
    x.clear();
    y.clear();
    z.clear();
    reach.clear();
    rank_index.clear();
  }
};

// Finds the first point at or after a key. Cells are visited in ascending order, so the answer is most often a few
// points after the one before; each of a cell's ranges keeps its own place.
class KeyCursor {
 public:
  std::size_t seek(std::span<const std::uint64_t> keys, std::uint64_t key) {
    constexpr int kFewSteps = 32;
    for (int i = 0; i < kFewSteps; ++i) {
      if (at_ < keys.size() && keys[at_] < key) {
        ++at_;
      } else if (at_ > 0 && keys[at_ - 1] >= key) {
        --at_;
      } else {
        return at_;
      }
    }
    at_ = static_cast<std::size_t>(std::lower_bound(keys.begin(), keys.end(), key) - keys.begin());
    return at_;
  }

 private:
  std::size_t at_ = 0;
};

inline void sort_row(std::vector<std::uint64_t>& row) {
  constexpr std::size_t kInsertionLimit = 40;
  if (row.size() > kInsertionLimit) {
    std::sort(row.begin(), row.end());
    return;
  }
  for (std::size_t i = 1; i < row.size(); ++i) {
    const std::uint64_t value = row[i];
    std::size_t k = i;
    for (; k > 0 && row[k - 1] > value; --k) row[k] = row[k - 1];
    row[k] = value;
  }
}

}  // namespace detail

/// Builds `list` anew. `points` gives position(i), radius(i) and rank(i) (unique, below 2^32) of the points in the order
/// of `search.keys`; `entry(i)` what the list stores for point i.
template <class Real, class Points, class Entry>
void build_neighbour_list(const NeighbourSearch<Real>& search, const Points& points, const Entry& entry,
                          NeighbourList& list) {
  list.segments.resize((search.count + NeighbourList::kSegment - 1) / NeighbourList::kSegment);

  parallel_ranges(list.segments.size(), 1, [&](std::size_t first_segment, std::size_t last_segment) {
    detail::Candidates<Real> near;
    std::array<detail::KeyCursor, 18> cursors;
    std::array<std::vector<std::uint64_t>, NeighbourList::kLanes> lanes;
    std::vector<unsigned char> keep;
    CellGrid::KeyRange ranges[18];

    const auto gather_candidates = [&](std::uint64_t key) {
      near.clear();
      const std::size_t range_count = search.grid->neighbour_ranges(key, ranges);
      for (std::size_t r = 0; r < range_count; ++r) {
        std::size_t p = cursors[r].seek(search.keys, ranges[r].first);
        for (; p < search.count && search.keys[p] <= ranges[r].last; ++p) {
          const Vec3<Real> x = points.position(p);
          near.x.push_back(x.x);
          near.y.push_back(x.y);
          near.z.push_back(x.z);
          near.reach.push_back(points.radius(p) + search.skin);
          near.rank_index.push_back((std::uint64_t{points.rank(p)} << 32U) | p);
        }
      }
      keep.resize(near.x.size());
    };

    const auto nearest = [&](Real d, int axis) {
      const Real length = component(search.length, axis);
      const Real half = Real(0.5) * length;
      return d > half ? d - length : d < -half ? d + length : d;
    };

    const auto fill_lane = [&](std::size_t i, std::vector<std::uint64_t>& row) {
      const Vec3<Real> x = points.position(i);
      const Real radius = points.radius(i);
      const bool any_periodic = search.periodic[0] || search.periodic[1] || search.periodic[2];
      const std::size_t n = near.x.size();
      if (!any_periodic) {
        for (std::size_t c = 0; c < n; ++c) {
          const Real dx = x.x - near.x[c], dy = x.y - near.y[c], dz = x.z - near.z[c];
          const Real reach = radius + near.reach[c];
          keep[c] = dx * dx + dy * dy + dz * dz < reach * reach ? 1 : 0;
        }
      } else {
        for (std::size_t c = 0; c < n; ++c) {
          Real dx = x.x - near.x[c], dy = x.y - near.y[c], dz = x.z - near.z[c];
          if (search.periodic[0]) dx = nearest(dx, 0);
          if (search.periodic[1]) dy = nearest(dy, 1);
          if (search.periodic[2]) dz = nearest(dz, 2);
          const Real reach = radius + near.reach[c];
          keep[c] = dx * dx + dy * dy + dz * dz < reach * reach ? 1 : 0;
        }
      }
      row.resize(n);
      std::size_t kept = 0;
      for (std::size_t c = 0; c < n; ++c) {
        row[kept] = near.rank_index[c];
        const bool self = static_cast<std::uint32_t>(near.rank_index[c]) == i;
        kept += keep[c] != 0 && (!self || search.list_self) ? 1 : 0;
      }
      row.resize(kept);
      detail::sort_row(row);
    };

    for (std::size_t s = first_segment; s < last_segment; ++s) {
      NeighbourList::Segment& segment = list.segments[s];
      segment.entries.clear();
      segment.first_row[0] = 0;
      std::uint64_t current_key = ~std::uint64_t{0};
      for (std::size_t g = 0; g < NeighbourList::kGroups; ++g) {
        const std::size_t first = s * NeighbourList::kSegment + g * NeighbourList::kLanes;
        std::size_t rows = 0;
        for (std::size_t lane = 0; lane < NeighbourList::kLanes; ++lane) {
          const std::size_t i = first + lane;
          lanes[lane].clear();
          if (i >= search.count) continue;
          if (search.keys[i] != current_key) gather_candidates(current_key = search.keys[i]);
          fill_lane(i, lanes[lane]);
          rows = std::max(rows, lanes[lane].size());
        }
        const std::size_t start = segment.entries.size();
        segment.entries.resize(start + rows * NeighbourList::kLanes, search.dummy);
        for (std::size_t lane = 0; lane < NeighbourList::kLanes; ++lane) {
          for (std::size_t k = 0; k < lanes[lane].size(); ++k) {
            segment.entries[start + k * NeighbourList::kLanes + lane] = entry(static_cast<std::uint32_t>(lanes[lane][k]));
          }
        }
        segment.first_row[g + 1] = segment.first_row[g] + static_cast<std::uint32_t>(rows);
      }
    }
  });
}

}  // namespace hooke
