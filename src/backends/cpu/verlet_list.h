// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "hooke/backends/cpu/column_store.h"
#include "hooke/backends/cpu/outlier_pairs.h"
#include "hooke/backends/cpu/patched_rows.h"
#include "hooke/base/assert.h"
#include "hooke/base/box3.h"
#include "hooke/neighbours/cell_list.h"
#include "hooke/neighbours/motion_bounds.h"
#include "hooke/neighbours/neighbour_list.h"
#include "hooke/neighbours/window_order.h"
#include "hooke/passes/exclusions.h"
#include "hooke/passes/pass_rules.h"
#include "hooke/physics/periodic.h"

namespace hooke {

/// A neighbour list with a skin (Verlet, "Computer experiments on classical fluids", Phys. Rev. 159, 98, 1967), and the
/// checks that make it valid for many steps. While every particle stays near its reference frame (motion_bounds.h), the
/// list misses nothing. Outliers are handled one by one: in every step, the particles that touch each outlier are
/// searched for, and rows that lack the pair are patched. A new list is built when the outliers cost more than that.
///
/// Which pairs are listed at what time changes no result: pairs that don't touch add an exact zero.
template <class Real>
class VerletList {
  using Record = ParticleRecord<Real>;
  static constexpr std::size_t kLanes = NeighbourList::kLanes;
  static constexpr std::size_t kSlices = NeighbourList::kSlices;

 public:
  using Frame = ReferenceFrame<Real>;

  /// Excluded pairs are never listed.
  void configure(const PassRules<Real>& rules, WindowSearchFunction<Real> search, const Exclusions& exclusions) {
    rules_ = &rules;
    exclusions_ = &exclusions;
    search_ = search;
    skin_ratio_ = kFirstSkin;
    listed_ = false;
    first_ghost_ = ghost_end_ = 0;
  }

  /// One of several lists that are built at the same time, each when the sum of their excess() is above 0.
  void share(bool shared) { is_shared_ = shared; }
  /// By how much outliers now cost more than the list is worth, in units of the cost of listing one particle.
  std::int64_t excess() const { return excess_; }

  /// Whether the list holds every pair that touches at the present positions.
  bool is_valid() const { return listed_; }
  void invalidate() { listed_ = false; }

  /// Sorts `count` particles inside of a box (m) into cells; vacant slots come last. Returns the order: the index of
  /// the particle that is to be the k-th. Works in `scratch`.
  std::span<const std::uint32_t> sort(const Record* records, std::size_t count, const Box3d& box,
                                      std::span<std::byte> scratch);

  /// Chooses the skin of the next list, m; sort() does so, too, with the same result.
  double next_skin() {
    choose_skin();
    return skin_;
  }

  /// Sorts ghosts, the particles `first` to `end` - 1, into cells of their own, after sort() and before build(); those
  /// that touch no others come last. Returns the order: the index among them of the one that is to be the k-th.
  std::span<const std::uint32_t> sort_ghosts(const Record* records, std::size_t first, std::size_t end);

  /// Where no ghost is, m.
  void set_own_box(const Box3d& box) { own_box_ = box; }

  /// Lists the neighbours of the first `count` particles, which lie in the order that sort() gave. The last of the
  /// `size` records fills short lanes. Slots from the next whole window up to `end` are room for later births. Works in
  /// `scratch`, which is as large as the records.
  void build(const Record* records, std::size_t count, std::size_t end, std::size_t size, std::span<std::byte> scratch);

  /// The rows of slice g of tile s, patched where necessary.
  std::span<const std::uint32_t> rows(std::size_t s, std::size_t g) const {
    return is_patched(s, g) ? patched_.rows(s * kSlices + g) : list_.rows(s, g);
  }
  bool is_patched(std::size_t s, std::size_t g) const { return patched_.holds(s * kSlices + g); }
  const NeighbourList::Tile& tile(std::size_t s) const { return list_.tiles[s]; }
  std::size_t tile_count() const { return list_.tiles.size(); }
  std::size_t entry_count() const { return list_.entry_count(); }
  std::uint64_t build_count() const { return builds_; }

  /// The first slot in which a particle can be born.
  std::size_t first_free() const { return (count_ + kWindow - 1) / kWindow * kWindow; }
  /// A particle is born in slot i, first_free() or later; it is an outlier from the start.
  void add(std::size_t i, std::uint32_t id_index) {
    if (!listed_) return;
    HOOKE_ASSERT(i >= first_free(), i, first_free());
    if (i >= end_ || rules_->view().periodic_kind == PeriodicKind::images) return invalidate();
    order_[i] = id_index;
    position_at_build_.put(i, {Real(0), Real(0), Real(0)});
    add_outlier(i);
  }

  /// Particle i has been moved other than by a step; it is an outlier from now on.
  void note_moved(std::size_t i) {
    if (!listed_) return;
    if (rules_->view().periodic_kind == PeriodicKind::images) return invalidate();
    add_outlier(i);
  }

  /// These pairs (indices) were kept apart and may touch from now on.
  void release(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
    for (const auto& [i, p] : pairs) {
      if (!knows(i) || !knows(p)) continue;  // one that touches no others
      if (!is_ghost(i)) released_.push_back({i, order_[p], record_offset<Real>(p)});
      if (!is_ghost(p)) released_.push_back({p, order_[i], record_offset<Real>(i)});
      patching_due_ = true;
    }
  }
  /// Call before rows are read: patches them for particles added or moved, and pairs released, since the last patch.
  /// Then is_valid() tells whether the list still holds.
  void patch_if_due(const Record* records) {
    if (!listed_) return;
    if (patching_due_ || fresh_.size() > kFewFresh) return patch(records);
    if (!fresh_.empty()) patch_fresh(records);
  }

  // Moving ----------------------------------------------------------------------------------------------------------

  const Frame* frames() const { return frames_.data(); }  ///< one per window
  Vec3Columns<Real> position_at_build() const { return position_at_build_.columns(); }
  /// Steps since the reference frames were set, after one more step.
  Real next_step() const { return static_cast<Real>(steps_ + 1); }

  /// Notes the lanes of a slice that are further from their reference frame than it allows: `far` has one bit per lane.
  /// Any thread may call, but only one per slice.
  void note_far(std::size_t slice, unsigned far);
  /// Notes the ghosts that are too far. Before moved().
  void note_far_ghosts(const Record* records);
  /// The box around the displacements of the reference frames since the list was built, m.
  Box3d frame_displacements() const {
    return listed_ ? motion_.frame_displacements(static_cast<double>(steps_)) : Box3d::none();
  }
  std::span<const std::uint32_t> outliers() const { return outliers_; }
  /// How far a particle has moved since the list was built, m.
  Vec3<Real> moved_by(const Record& p, std::size_t i) const { return displacement(p, i, {Real(0), Real(0), Real(0)}); }
  /// Whether particle i, moved by its next step, is further from its reference frame than that allows.
  bool is_far(const Record& p, std::size_t i) const { return is_off(p, i, frames_[i / kWindow], next_step()); }
  /// All particles have moved by a step, and new outliers are noted. is_valid() then tells whether the list holds.
  void moved(const Record* records);

  /// Number of entries of touching pairs that the rows lack, by a full search; for tests.
  std::uint64_t count_missed(const Record* records) const;

 private:
  void strike_exclusions();

  void add_outlier(std::size_t i) {
    note_far(i / kLanes, 1U << i % kLanes);
    fresh_.push_back(static_cast<std::uint32_t>(i));
    if (kOutlierCost * outliers_.size() > count_ + kOutlierCost * kLanes)
      invalidate();  // handling them costs more than a new list
  }

  // Costs, in units of the cost of listing one particle.
  static constexpr std::size_t kOutlierCost = 6;  // handling one outlier for one step
  static constexpr std::size_t kFollowShare = 9;  // a build costs as much as following the particles so often

  static constexpr std::size_t kFewFresh = 64;  // up to so many new outliers, only their pairs are searched for

  static constexpr std::uint64_t kFollowTrial = 16;  // builds after which following is tried again

  // Skins as a fraction of the smallest diameter.
  static constexpr double kFirstSkin = 0.25, kThinnestSkin = 0.06, kThickestSkin = 0.4;
  static constexpr double kBuildOverSkin = 7.4;  // cost of a build over what a skin of one diameter adds to a pass

  double interaction_radius(const Record& p) const {
    return rules_->interaction_radius(static_cast<std::size_t>(p.material));
  }

  double best_skin() const;
  void choose_skin();
  // Whether the list has lasted so long that a thinner skin would have been better.
  bool is_too_thick() const { return best_skin() < 0.5 * skin_ratio_; }

  void lay_out_cells(CellList& cells, double skin, std::size_t count) const;
  auto key_of(const CellList& cells, const Record* records) const;

  // What a search reads, in cell order. It takes less memory than the particles' records.
  struct SearchColumns {
    Real *x, *y, *z, *radius;  // m; radius is null where all are the same
    std::uint32_t* id_index;

    SearchColumns(std::span<std::byte> room, std::size_t count, bool radii)
        : x(reinterpret_cast<Real*>(room.data())),
          y(x + count),
          z(y + count),
          radius(radii ? z + count : nullptr),
          id_index(reinterpret_cast<std::uint32_t*>(z + count + (radii ? count : 0))) {}

    // Fills one column after the other, each in cell order: `at` (m) and `id_indices` are by slot.
    void fill(const WindowOrder& slots, std::size_t first, std::size_t last, const ColumnStore<Real>& at,
              const std::uint32_t* id_indices) const {
      const auto copy = [&](const auto* from, auto* to) {
        for (std::size_t p = first; p < last; ++p) to[p] = from[slots.slot_of(p)];
      };
      copy(at.columns().x, x);
      copy(at.columns().y, y);
      copy(at.columns().z, z);
      copy(id_indices, id_index);
    }
  };

  void add_ghosts(const Record* records, const SearchColumns& columns);
  NeighbourRule<Real> neighbour_rule(const SearchColumns& columns);
  void find_coarseness();

  // Displacement of a record since its neighbours were listed, minus `expected`, m.
  Vec3<Real> displacement(const Record& p, std::size_t i, const Vec3<Real>& expected) const {
    return nearest_displacement(p.x, position_at_build_[i] + expected, rules_->view().period);
  }
  bool is_off(const Record& p, std::size_t i, const Frame& frame, Real steps) const {
    const Vec3<Real> off = displacement(p, i, frame.at(steps));
    return !(dot(off, off) <= frame.limit2(steps));
  }

  void follow(const Record* records);
  unsigned outliers_of_slice(const Record* records, std::size_t g) const;

  OutlierPairs<Real> outlier_pairs(const Record* records) const {
    return {*rules_, records, cells_, ghost_points(), slots_, order_.data(), list_, *exclusions_};
  }

  bool has_ghosts() const { return ghost_end_ > first_ghost_; }
  bool is_ghost(std::size_t i) const { return has_ghosts() && i >= first_ghost_; }
  bool knows(std::size_t i) const { return i < std::max(count_, end_) || (is_ghost(i) && i < ghost_end_); }
  // One past the last slot that the list knows.
  std::size_t known_end() const { return has_ghosts() ? ghost_end_ : std::max(count_, end_); }
  GhostPoints ghost_points() const {
    return has_ghosts() ? GhostPoints{&ghost_cells_, first_ghost_, own_box_} : GhostPoints{};
  }
  // One past the last listed particle or ghost of the window, or a part of it, that begins at `first`.
  std::size_t end_from(std::size_t first, std::size_t size) const {
    return std::min(first + size, is_ghost(first) ? ghost_end_ : count_);
  }

  auto centre_of(const Record* records) const;
  void patch(const Record* records);
  void patch_fresh(const Record* records);

  // Square of the distance (m) from `from` to the furthest point of a box of displacements; NaN where in doubt.
  static Real furthest2(const Box3<Real>& box, const Vec3<Real>& from) {
    if (box.is_none()) return Real(0);
    const auto most = [](Real a, Real b) { return a < b ? b : a; };
    const Vec3<Real> off{most(box.max.x - from.x, from.x - box.min.x), most(box.max.y - from.y, from.y - box.min.y),
                         most(box.max.z - from.z, from.z - box.min.z)};
    return dot(off, off);
  }

  const PassRules<Real>* rules_ = nullptr;
  WindowSearchFunction<Real> search_ = nullptr;
  const Exclusions* exclusions_ = nullptr;
  double skin_ratio_ = kFirstSkin, skin_ = 0;  // of the smallest diameter; m
  double coarseness_ = 0;  // m

  std::size_t count_ = 0;  // listed
  std::size_t end_ = 0;  // of the room for later births
  std::size_t first_ghost_ = 0, ghost_end_ = 0;  // of those that touch others
  Box3d own_box_ = Box3d::none();  // m, where no ghost is
  std::uint32_t filler_ = 0;  // entry that fills short lanes
  CellList cells_, ghost_cells_;
  WindowOrder slots_;
  std::vector<std::uint32_t> ghost_order_;
  std::vector<std::uint32_t> order_;  // while sorting: each one's former index; then: id indices
  NeighbourList list_;
  ColumnStore<Real> position_at_build_;  // m
  bool listed_ = false;
  std::uint64_t builds_ = 0;

  typename MotionBounds<Real>::Limits limits_;
  MotionBounds<Real> motion_;
  std::vector<Frame> frames_;  // by window
  std::vector<Box3<Real>> moved_;  // likewise
  std::vector<std::uint16_t> outlying_;  // by slice: a bit a lane
  PatchedRows patched_;
  std::vector<std::uint32_t> outliers_;
  bool patching_due_ = false;  // rows lack released pairs
  std::vector<std::uint32_t> fresh_;  // added, or moved other than by a step: rows lack them
  std::vector<PatchedRows::MissingEntry>
      released_;  // missing entries of pairs that were excluded when the list was built
  typename OutlierPairs<Real>::Room room_;
  std::mutex mutex_;  // guards outliers_
  std::int64_t steps_ = 0, horizon_ = 0;  // since the last follow(); how many it is good for
  bool follow_helps_ = true;  // reduces outliers, as far as is known
  bool is_shared_ = false;
  std::int64_t excess_ = 0;
  std::size_t age_ = 0;  // steps since the last build
  std::size_t since_followed_ = 0, spent_ = 0;  // on outliers, since follow() and since the last build
};

extern template class VerletList<float>;
extern template class VerletList<double>;

}  // namespace hooke
