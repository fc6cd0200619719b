// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "hooke/backends/cpu/patched_rows.h"
#include "hooke/base/parallel.h"
#include "hooke/neighbours/cell_list.h"
#include "hooke/neighbours/neighbour_list.h"
#include "hooke/neighbours/window_order.h"
#include "hooke/passes/exclusions.h"
#include "hooke/passes/pass_rules.h"
#include "hooke/physics/periodic.h"

namespace hooke {

/// Finds the particles that touch outliers, which are no longer near their expected positions.
template <class Real>
class OutlierPairs {
  using Record = ParticleRecord<Real>;
  static constexpr std::size_t kLanes = NeighbourList::kLanes;
  static constexpr std::size_t kGrain = 64;  // outliers
  using MissingEntry = PatchedRows::MissingEntry;

 public:
  OutlierPairs(const PassRules<Real>& rules, const Record* records, const CellList& cells, const GhostPoints& ghosts,
               const WindowOrder& slots, const std::uint32_t* id_indices, const NeighbourList& list,
               const Exclusions& exclusions)
      : rules_(rules),
        records_(records),
        cells_(cells),
        ghosts_(ghosts),
        slots_(slots),
        id_indices_(id_indices),
        list_(list),
        exclusions_(exclusions) {}

  /// Memory that is kept from one search to the next.
  struct Room {
    struct Outlier {
      std::uint64_t row;  // a row along x: y and z
      Vec3<Real> x;       // m
      std::uint32_t i;

      bool is_before(std::uint64_t other_row, Real other_x) const {
        return row != other_row ? row < other_row : x.x < other_x;
      }
    };
    std::vector<Outlier> sorted;
    std::vector<MissingEntry> missing;

    /// Searches for so many outliers then allocate nothing; unused memory is not committed.
    void reserve(std::size_t outliers) {
      sorted.reserve(2 * outliers);
      missing.reserve(4 * outliers);
    }
  };

  /// Where to search for particles that may touch an outlier: they were listed nearer to `at` (m) than `range` (m) plus
  /// the two radii.
  struct SearchCentre {
    Vec3d at;
    double range;
  };

  /// Patches the rows of the particles in `missing`, of outliers, and of the particles that an outlier touches.
  /// Particles without a bit in `outlying` are searched for around centre_of(i). False where an outlier is lost.
  template <class CentreOf>
  bool find(std::span<const std::uint32_t> outliers, std::span<const std::uint16_t> outlying, const CentreOf& centre_of,
            std::uint32_t filler, const std::vector<MissingEntry>& missing, Room& room, PatchedRows& patched) const {
    room.missing.assign(missing.begin(), missing.end());
    std::atomic<bool> lost{false};
    parallel_ranges(outliers.size(), kGrain, [&](std::size_t first, std::size_t last) {
      for (const std::uint32_t i : outliers.subspan(first, last - first)) {
        if (is_vacant(records_[i])) continue;
        if (is_somewhere(records_[i])) {
          find_around(i, centre_of(i), outlying, room.missing);
        } else {
          lost = true;
        }
      }
    });
    if (lost) return false;
    find_among(outliers, room);
    patched.patch<Real>(room.missing, list_, filler, id_indices_);
    return true;
  }

  /// Does the same for the particles `fresh`, outliers since find() filled `room`; all other particles must still be
  /// where they were then.
  template <class CentreOf>
  bool add(std::span<const std::uint32_t> fresh, std::span<const std::uint32_t> outliers,
           std::span<const std::uint16_t> outlying, const CentreOf& centre_of, std::uint32_t filler, Room& room,
           PatchedRows& patched) const {
    for (const std::uint32_t i : fresh) {
      if (is_vacant(records_[i])) continue;
      if (!is_somewhere(records_[i])) return false;
      find_around(i, centre_of(i), outlying, room.missing);
      for (const std::uint32_t p : outliers) {
        if (p != i && !is_vacant(records_[p]) && touch(i, p)) note_missing(i, p, room.missing);
      }
    }
    patched.patch<Real>(room.missing, list_, filler, id_indices_);
    return true;
  }

  /// Whether two particles overlap where they are now.
  bool overlap(std::size_t i, std::size_t p) const {
    return are_nearer(i, p, interaction_radius(i) + interaction_radius(p));
  }

 private:
  double interaction_radius(std::size_t i) const {
    return rules_.interaction_radius(static_cast<std::size_t>(records_[i].material));
  }
  double margin() const { return 1e-3 * rules_.smallest_touching(); }  // covers the force pass's different rounding
  static bool is_somewhere(const Record& p) {
    const auto near = [](Real x) { return std::abs(x) < static_cast<Real>(kFurthest); };
    return near(p.x.x) && near(p.x.y) && near(p.x.z);
  }

  bool touch(std::size_t i, std::size_t p) const {
    return are_nearer(i, p, interaction_radius(i) + interaction_radius(p) + margin());
  }

  bool are_nearer(std::size_t i, std::size_t p, double reach) const {
    const Vec3<Real> d = nearest_displacement(records_[i].x, records_[p].x, rules_.view().period);
    return dot(d, d) < static_cast<Real>(reach) * static_cast<Real>(reach);
  }

  bool is_ghost(std::size_t i) const { return ghosts_.cells != nullptr && i >= ghosts_.first; }
  bool is_listed(std::size_t i, std::size_t p) const;
  void note_missing(std::size_t i, std::size_t p, std::vector<MissingEntry>& missing) const;

  void find_around(std::uint32_t i, const SearchCentre& centre, std::span<const std::uint16_t> outlying,
                   std::vector<MissingEntry>& missing) const;
  void find_among(std::span<const std::uint32_t> outliers, Room& room) const;

  // Difference between row numbers of neighbours along y; along z it is 1.
  static constexpr std::uint64_t kNextY = std::uint64_t{1} << 32U;

  void add_with_images(std::uint32_t i, const Vec3<Real>& x, int axis, Real reach,
                       std::vector<typename Room::Outlier>& to) const;

  const PassRules<Real>& rules_;
  const Record* records_;
  const CellList& cells_;
  const GhostPoints ghosts_;
  const WindowOrder& slots_;
  const std::uint32_t* id_indices_;
  const NeighbourList& list_;
  const Exclusions& exclusions_;
  mutable std::mutex mutex_;  // guards the missing entries
};

extern template class OutlierPairs<float>;
extern template class OutlierPairs<double>;

}  // namespace hooke
