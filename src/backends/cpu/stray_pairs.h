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

#include "hooke/backends/cpu/apart_pairs.h"
#include "hooke/backends/cpu/pass_rules.h"
#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"
#include "hooke/neighbours/cell_list.h"
#include "hooke/neighbours/neighbour_list.h"
#include "hooke/neighbours/window_order.h"
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
  /// Of a group that it holds.
  std::span<const std::uint32_t> rows(std::size_t group) const {
    HOOKE_ASSERT(holds(group), group);
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
      // Over what is behind the rows before.
      const std::size_t first = entries_.empty() ? 0 : entries_.size() - kBehind, count = rows.size() + most * kLanes;
      entries_.resize(first + count + kBehind, filling);
      std::copy(rows.begin(), rows.end(), entries_.begin() + static_cast<std::ptrdiff_t>(first));
      for (; k < end; ++k) insert(lacks[k], entries_.data() + first, count, filling, rank_of_entry);
      at_[group] = static_cast<std::uint32_t>(mended_.size());
      mended_.push_back({group, first, count});
    }
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  static constexpr std::size_t kBehind = kRowsAhead * kLanes;
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
  std::vector<std::uint32_t> entries_;  // kRowsAhead rows of `filling` behind the last
};

/// Finds who touches particles that are no longer near where they were listed.
template <class Real>
class StrayPairs {
  using Record = ParticleRecord<Real>;
  static constexpr std::size_t kLanes = NeighbourList::kLanes;
  static constexpr std::size_t kGrain = 64;  // strays
  using Lack = MendedRows::Lack;

 public:
  StrayPairs(const PassRules<Real>& rules, const Record* records, const CellList& cells, const WindowOrder& slots,
             const std::uint32_t* ranks, const NeighbourList& list, const ApartPairs& apart)
      : rules_(rules),
        records_(records),
        cells_(cells),
        slots_(slots),
        ranks_(ranks),
        list_(list),
        apart_(apart) {}

  /// Room that is kept from one search to the next.
  struct Room {
    struct Stray {
      std::uint64_t row;  // of places, along x
      Vec3<Real> x;       // m
      std::uint32_t i;

      bool is_before(std::uint64_t other_row, Real other_x) const {
        return row != other_row ? row < other_row : x.x < other_x;
      }
    };
    std::vector<Stray> sorted;
    std::vector<Lack> lacks;

    /// So that searches for so many allocate nothing; memory that is not used is not taken.
    void reserve(std::size_t strays) {
      sorted.reserve(2 * strays);
      lacks.reserve(4 * strays);
    }
  };

  /// Where to look for who may touch a stray: they were listed within `range` (m) and the two radii of `at` (m).
  struct Place {
    Vec3d at;
    double range;
  };

  /// Mends the rows that have `lacks`, and those that lack a stray, or somebody whom a stray touches. Those without a
  /// bit in `strayed` are found where place_of(i) says. False where a stray is lost.
  template <class PlaceOf>
  bool find(std::span<const std::uint32_t> strays, std::span<const std::uint16_t> strayed, const PlaceOf& place_of,
            std::uint32_t filling, const std::vector<Lack>& lacks, Room& room, MendedRows& mended) const {
    room.lacks.assign(lacks.begin(), lacks.end());
    std::atomic<bool> lost{false};
    parallel_ranges(strays.size(), kGrain, [&](std::size_t first, std::size_t last) {
      for (const std::uint32_t i : strays.subspan(first, last - first)) {
        if (is_nowhere(records_[i])) continue;
        if (!is_somewhere(records_[i])) {
          lost = true;
          continue;
        }
        const Place place = place_of(i);
        cells_.for_points_near(place.at, place.range + reach_of(i) + margin(), [&](std::size_t k) {
          const std::size_t p = slots_.slot_of(k);
          const bool other_strays = (strayed[p / kLanes] >> p % kLanes & 1U) != 0;
          if (!other_strays && touch(i, p)) note_lacks(i, p, room.lacks);
        });
      }
    });
    if (lost) return false;
    find_among(strays, room);
    mended.mend(room.lacks, list_, filling,
                [this](std::uint32_t entry) { return ranks_[entry / record_offset<Real>(1)]; });
    return true;
  }

  /// Whether two particles overlap where they are now.
  bool overlap(std::size_t i, std::size_t p) const { return are_nearer(i, p, reach_of(i) + reach_of(p)); }

 private:
  double reach_of(std::size_t i) const { return rules_.reach_of(static_cast<std::size_t>(records_[i].material)); }
  double margin() const { return 1e-3 * rules_.smallest_radius; }  // what the force pass rounds differently
  static bool is_somewhere(const Record& p) {
    const auto near = [](Real x) { return std::abs(x) < static_cast<Real>(kFurthest); };
    return near(p.x.x) && near(p.x.y) && near(p.x.z);
  }

  bool touch(std::size_t i, std::size_t p) const { return are_nearer(i, p, reach_of(i) + reach_of(p) + margin()); }

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
    if (is_listed(i, p) || apart_.hold(ranks_[i], ranks_[p])) return;
    const std::lock_guard lock(mutex_);
    for (const auto& [of, other] : {std::pair{i, p}, std::pair{p, i}}) {
      lacks.push_back(
          {static_cast<std::uint32_t>(of), ranks_[other], record_offset<Real>(static_cast<std::uint32_t>(other))});
    }
  }

  // Pairs of two strays: they are sorted into rows along x, as wide as two can touch, and each meets those that follow
  // it in its row and those at its height in half of the rows around. At periodic faces, those behind the lower one
  // follow beyond the upper one once more.
  void find_among(std::span<const std::uint32_t> strays, Room& room) const {
    using Stray = typename Room::Stray;
    std::vector<Stray>& sorted = room.sorted;
    sorted.clear();
    const auto reach = static_cast<Real>(2 * rules_.largest_reach() + margin());
    for (const std::uint32_t i : strays) {
      if (!is_nowhere(records_[i])) add_with_images(i, records_[i].x, 0, reach, sorted);
    }
    std::sort(sorted.begin(), sorted.end(), [](const Stray& a, const Stray& b) { return a.is_before(b.row, b.x.x); });
    parallel_ranges(sorted.size(), 256, [&](std::size_t first, std::size_t last) {
      for (std::size_t a = first; a < last; ++a) {
        const Stray& stray = sorted[a];
        const auto meet = [&](auto other, std::uint64_t row) {
          for (; other != sorted.end() && other->row == row && other->x.x - stray.x.x < reach; ++other) {
            if (other->i != stray.i && touch(stray.i, other->i)) note_lacks(stray.i, other->i, room.lacks);
          }
        };
        meet(sorted.begin() + static_cast<std::ptrdiff_t>(a) + 1, stray.row);
        for (const std::uint64_t row :
             {stray.row + 1, stray.row + kNextY - 1, stray.row + kNextY, stray.row + kNextY + 1}) {
          meet(std::partition_point(sorted.begin(), sorted.end(),
                                    [&](const Stray& s) { return s.is_before(row, stray.x.x - reach); }),
               row);
        }
      }
    });
  }

  static constexpr std::uint64_t kNextY = std::uint64_t{1}
                                          << 32U;  // from a row to the one beside it along y; 1 along z

  // Adds a place, and its images across periodic faces from `axis` on.
  void add_with_images(std::uint32_t i, const Vec3<Real>& x, int axis, Real reach,
                       std::vector<typename Room::Stray>& to) const {
    if (axis == 3) {
      constexpr double kMost = 1 << 30;  // further away, rows are shared
      const auto index = [&](Real c) {
        return static_cast<std::uint64_t>(
            std::clamp(std::floor(static_cast<double>(c) / static_cast<double>(reach)), -kMost, kMost) + 2 * kMost);
      };
      to.push_back({index(x.y) * kNextY + index(x.z), x, i});
      return;
    }
    add_with_images(i, x, axis + 1, reach, to);
    const ForcePass<Real>& pass = rules_.pass;
    if (!pass.periodic[axis] || component(x, axis) >= component(pass.min, axis) + reach) return;
    Vec3<Real> image = x;
    component(image, axis) += component(pass.length, axis);
    add_with_images(i, image, axis + 1, reach, to);
  }

  const PassRules<Real>& rules_;
  const Record* records_;
  const CellList& cells_;
  const WindowOrder& slots_;
  const std::uint32_t* ranks_;
  const NeighbourList& list_;
  const ApartPairs& apart_;
  mutable std::mutex mutex_;  // around what is lacking
};

}  // namespace hooke
