// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "hooke/backends/cpu/pass_rules.h"
#include "hooke/base/parallel.h"
#include "hooke/neighbours/cell_list.h"
#include "hooke/neighbours/neighbour_list.h"
#include "hooke/physics/periodic.h"

namespace hooke {

/// Whether a lane of a group's rows holds an entry.
inline bool is_in_lane(std::span<const std::uint32_t> rows, std::size_t lane, std::uint32_t entry) {
  for (std::size_t at = lane; at < rows.size(); at += NeighbourList::kLanes) {
    if (rows[at] == entry) return true;
  }
  return false;
}

/// Rows of the groups whose rows in the list lack a pair.
class MendedRows {
  static constexpr std::size_t kLanes = NeighbourList::kLanes;

 public:
  /// One neighbour that particle `of` lacks.
  struct Lack {
    std::uint32_t of, rank, entry;  // the neighbour's rank and entry

    friend auto operator<=>(const Lack&, const Lack&) = default;
  };

  void clear(std::size_t groups) {
    for (const Mended& m : mended_) at_[m.group] = kNone;
    mended_.clear();
    entries_.clear();
    if (at_.size() != groups) at_.assign(groups, kNone);
  }
  std::size_t count() const { return mended_.size(); }
  void reserve(std::size_t groups) {
    mended_.reserve(groups);
    entries_.reserve(groups * 24 * kLanes);
  }
  bool holds(std::size_t group) const { return at_[group] != kNone; }
  std::span<const std::uint32_t> rows(std::size_t group) const {
    const Mended& m = mended_[at_[group]];
    return std::span(entries_).subspan(m.first, m.count);
  }

  /// Adds what is lacking to rows of the list. `rank_of_entry` is that of a neighbour; `filling` stands for none.
  template <class RankOfEntry>
  void mend(std::vector<Lack>& lacks, const NeighbourList& list, std::uint32_t filling,
            const RankOfEntry& rank_of_entry) {
    std::sort(lacks.begin(), lacks.end());
    lacks.erase(std::unique(lacks.begin(), lacks.end()), lacks.end());
    for (std::size_t k = 0; k < lacks.size();) {
      const std::size_t group = lacks[k].of / kLanes;
      std::size_t end = k, most = 0;  // of one lane
      for (std::size_t lane_start = k; end < lacks.size() && lacks[end].of / kLanes == group; ++end) {
        if (lacks[end].of != lacks[lane_start].of) lane_start = end;
        most = std::max(most, end + 1 - lane_start);
      }
      const auto rows = list.rows(group / NeighbourList::kGroups, group % NeighbourList::kGroups);
      const std::size_t first = entries_.size(), count = rows.size() + most * kLanes;
      entries_.insert(entries_.end(), rows.begin(), rows.end());
      entries_.resize(first + count, filling);
      for (; k < end; ++k) insert(lacks[k], entries_.data() + first, count, filling, rank_of_entry);
      at_[group] = static_cast<std::uint32_t>(mended_.size());
      mended_.push_back({group, first, count});
    }
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  struct Mended {
    std::size_t group, first, count;  // its entries
  };

  // Puts one in its place by rank; the last entry of its lane is free.
  template <class RankOfEntry>
  static void insert(const Lack& lack, std::uint32_t* rows, std::size_t count, std::uint32_t filling,
                     const RankOfEntry& rank_of_entry) {
    std::size_t at = lack.of % kLanes;
    while (at < count && rows[at] != filling && rank_of_entry(rows[at]) < lack.rank) at += kLanes;
    for (std::uint32_t carried = lack.entry; at < count; at += kLanes) {
      std::swap(carried, rows[at]);
      if (carried == filling) break;
    }
  }

  std::vector<std::uint32_t> at_;  // by group: index into mended_
  std::vector<Mended> mended_;
  std::vector<std::uint32_t> entries_;
};

/// Finds who touches particles that are no longer near where they were listed.
template <class Real>
class StrayPairs {
  using Record = ParticleRecord<Real>;
  static constexpr std::size_t kLanes = NeighbourList::kLanes;
  static constexpr std::size_t kGrain = 64;  // strays
  using Lack = MendedRows::Lack;

 public:
  StrayPairs(const PassRules<Real>& rules, const Record* records, const CellList& cells, const std::uint32_t* ranks,
             const NeighbourList& list)
      : rules_(rules),
        records_(records),
        cells_(cells),
        ranks_(ranks),
        list_(list) {}

  /// Room that is kept from one search to the next.
  struct Room {
    struct Stray {
      Vec3<Real> x;  // m
      std::uint32_t i;
    };
    std::vector<Stray> sorted;
    std::vector<Lack> lacks;
    std::vector<std::vector<SearchRange>> ranges;  // one for some strays each

    /// So that searches for so many allocate nothing; memory that is not used is not taken.
    void reserve(std::size_t strays) {
      sorted.reserve(2 * strays);
      lacks.reserve(4 * strays);
      ranges.resize(strays / kGrain + 1);
      for (auto& r : ranges) r.reserve(64);
    }
  };

  /// Where to look for who may touch a stray: they were listed within `range` (m) and the two radii of `at` (m).
  struct Place {
    Vec3d at;
    double range;
  };

  /// Mends the rows that lack a stray, or somebody whom a stray touches. Those without a bit in `strayed` are found
  /// where place_of(i) says. False where a stray is lost.
  template <class PlaceOf>
  bool find(std::span<const std::uint32_t> strays, std::span<const std::uint16_t> strayed, const PlaceOf& place_of,
            std::uint32_t filling, Room& room, MendedRows& mended) const {
    room.lacks.clear();
    std::atomic<bool> lost{false};
    room.ranges.resize(std::max(room.ranges.size(), strays.size() / kGrain + 1));
    parallel_ranges(strays.size(), kGrain, [&](std::size_t first, std::size_t last) {
      std::vector<SearchRange>& ranges = room.ranges[first / kGrain];
      for (std::size_t k = first; k < last; ++k) {
        const std::size_t i = strays[k];
        if (is_nowhere(records_[i])) continue;
        if (!is_somewhere(records_[i])) {
          lost = true;
          continue;
        }
        const Place place = place_of(i);
        ranges.clear();
        for (std::size_t level = 0; level < cells_.level_count(); ++level) {
          const double reach = place.range + radius(i) + cells_.largest_radius(level) + margin();
          cells_.find(level, place.at - Vec3d{reach, reach, reach}, place.at + Vec3d{reach, reach, reach}, ranges);
        }
        for (const SearchRange& range : ranges) {
          for (std::size_t p = range.from; p < range.to; ++p) {
            const bool other_strays = (strayed[p / kLanes] >> p % kLanes & 1U) != 0;
            if (!other_strays && touch(i, p)) note_lacks(i, p, room.lacks);
          }
        }
      }
    });
    if (lost) return false;
    find_among(strays, room);
    mended.mend(room.lacks, list_, filling,
                [this](std::uint32_t entry) { return ranks_[entry / record_offset<Real>(1)]; });
    return true;
  }

  /// Whether two particles overlap where they are now.
  bool overlap(std::size_t i, std::size_t p) const { return are_nearer(i, p, radius(i) + radius(p)); }

 private:
  double radius(std::size_t i) const { return rules_.materials[static_cast<std::size_t>(records_[i].material)].radius; }
  double margin() const { return 1e-3 * rules_.smallest_radius; }  // what the force pass rounds differently
  static bool is_somewhere(const Record& p) {
    const auto near = [](Real x) { return std::abs(x) < static_cast<Real>(kFurthest); };
    return near(p.x.x) && near(p.x.y) && near(p.x.z);
  }

  bool touch(std::size_t i, std::size_t p) const { return are_nearer(i, p, radius(i) + radius(p) + margin()); }

  bool are_nearer(std::size_t i, std::size_t p, double reach) const {
    Vec3<Real> d = records_[i].x - records_[p].x;
    for (int axis = 0; axis < 3; ++axis) {
      if (!rules_.pass.periodic[axis]) continue;
      const Real x_i = component(records_[i].x, axis), x_p = component(records_[p].x, axis);
      const Real length = component(rules_.pass.length, axis);
      component(d, axis) = image_displacement(x_i, x_p, nearest_image(x_i, x_p, length), length);
    }
    return dot(d, d) < static_cast<Real>(reach) * static_cast<Real>(reach);
  }

  bool is_listed(std::size_t i, std::size_t p) const {
    const auto rows = list_.rows(i / NeighbourList::kSegment, i % NeighbourList::kSegment / kLanes);
    return is_in_lane(rows, i % kLanes, record_offset<Real>(static_cast<std::uint32_t>(p)));
  }
  // Where one of two lacks the other, so does the other.
  void note_lacks(std::size_t i, std::size_t p, std::vector<Lack>& lacks) const {
    if (is_listed(i, p)) return;
    const std::lock_guard lock(mutex_);
    for (const auto& [of, other] : {std::pair{i, p}, std::pair{p, i}}) {
      lacks.push_back(
          {static_cast<std::uint32_t>(of), ranks_[other], record_offset<Real>(static_cast<std::uint32_t>(other))});
    }
  }

  // Pairs of two strays, by a sweep along x. Across a periodic x the first ones follow the last ones once more.
  void find_among(std::span<const std::uint32_t> strays, Room& room) const {
    using Stray = typename Room::Stray;
    const ForcePass<Real>& pass = rules_.pass;
    const auto reach = static_cast<Real>(2 * rules_.largest_radius + margin());
    std::vector<Stray>& sorted = room.sorted;
    sorted.clear();
    for (const std::uint32_t i : strays) {
      Vec3<Real> x = records_[i].x;
      if (is_nowhere(records_[i])) continue;
      sorted.push_back({x, i});
      if (!pass.periodic[0] || x.x >= pass.min.x + reach) continue;
      x.x += pass.length.x;
      sorted.push_back({x, i});
    }
    std::sort(sorted.begin(), sorted.end(), [](const Stray& a, const Stray& b) { return a.x.x < b.x.x; });
    const auto is_near = [&](int axis, Real d) { return pass.periodic[axis] || std::abs(d) < reach; };
    parallel_ranges(sorted.size(), 256, [&](std::size_t first, std::size_t last) {
      for (std::size_t a = first; a < last; ++a) {
        for (std::size_t b = a + 1; b < sorted.size() && sorted[b].x.x - sorted[a].x.x < reach; ++b) {
          if (!is_near(1, sorted[b].x.y - sorted[a].x.y) || !is_near(2, sorted[b].x.z - sorted[a].x.z)) continue;
          if (sorted[a].i != sorted[b].i && touch(sorted[a].i, sorted[b].i)) {
            note_lacks(sorted[a].i, sorted[b].i, room.lacks);
          }
        }
      }
    });
  }

  const PassRules<Real>& rules_;
  const Record* records_;
  const CellList& cells_;
  const std::uint32_t* ranks_;
  const NeighbourList& list_;
  mutable std::mutex mutex_;  // around what is lacking
};

}  // namespace hooke
