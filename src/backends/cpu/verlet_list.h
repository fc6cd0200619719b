// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <span>
#include <vector>

#include "hooke/backends/cpu/apart_pairs.h"
#include "hooke/backends/cpu/column_store.h"
#include "hooke/backends/cpu/pass_rules.h"
#include "hooke/backends/cpu/stray_pairs.h"
#include "hooke/base/assert.h"
#include "hooke/base/huge_pages.h"
#include "hooke/base/parallel.h"
#include "hooke/neighbours/cell_list.h"
#include "hooke/neighbours/motion_bounds.h"
#include "hooke/neighbours/neighbour_list.h"
#include "hooke/neighbours/window_order.h"

namespace hooke {

/// A neighbour list with a skin (Verlet, "Computer experiments on classical fluids", Phys. Rev. 159, 98, 1967), and
/// what it takes to trust it for many steps. While every particle stays near its anchor (motion_bounds.h) the
/// list misses nothing. Particles that stray are looked after one by one: in every step each looks for whoever touches
/// it, and rows that lack the pair are mended. A new list is built when strays have become too many to be worth it.
///
/// Which pairs are listed when changes no result: those that don't touch add an exact zero.
template <class Real>
class VerletList {
  using Record = ParticleRecord<Real>;
  static constexpr std::size_t kLanes = NeighbourList::kLanes;
  static constexpr std::size_t kGroups = NeighbourList::kGroups;

 public:
  using Anchor = GroupAnchor<Real>;

  /// Pairs that are kept apart are never listed.
  void configure(const PassRules<Real>& rules, WindowSearchFunction<Real> search, const ApartPairs& apart) {
    rules_ = &rules;
    apart_ = &apart;
    search_ = search;
    skin_ratio_ = kFirstSkin;
    listed_ = false;
  }

  /// Whether it holds every pair that touches where particles are now.
  bool good() const { return listed_; }
  void forget() { listed_ = false; }

  /// Sorts `count` particles inside the box [min, max] (m) into cells; those that are nowhere come last. Returns the
  /// order: which particle is to be the k-th. Works in `scratch`.
  std::span<const std::uint32_t> sort(const Record* records, std::size_t count, Vec3d min, Vec3d max,
                                      std::span<std::byte> scratch) {
    choose_skin();
    limits_.min = min;
    limits_.max = max;
    lay_out_cells(cells_, skin_, count);
    cells_.sort(count, key_of(cells_, records), order_, scratch);
    slots_.lay_out(std::span(order_).first(cells_.point_count()));
    return order_;
  }

  /// Lists the neighbours of the first `count` particles, which lie in the order that sort() gave. `records` ends with
  /// the one that fills short lanes, the last of `size`. From the next whole window on there is room, up to `end`, for
  /// particles that are born later. Works in `scratch`, as large as the records.
  void build(const Record* records, std::size_t count, std::size_t end, std::size_t size,
             std::span<std::byte> scratch) {
    HOOKE_ASSERT(std::max(count, end) < size, count, end, size);
    HOOKE_ASSERT(scratch.size() >= size * sizeof(Record), scratch.size(), size);
    count_ = count;
    end_ = std::max(count, end);
    filling_ = record_offset<Real>(static_cast<std::uint32_t>(size - 1));
    const std::size_t room = (end_ + kLanes - 1) / kLanes * kLanes;
    listed_at_.resize(room);
    std::vector<std::uint32_t>& ranks = order_;  // of no use any more as the order of the sort
    ranks.reserve(room);  // a growing vector would take twice that
    ranks.resize(room);
    const SearchColumns columns(scratch, count + kLanes, rules_->largest_touching > rules_->smallest_radius);
    parallel_ranges(count, NeighbourList::kSegment, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        listed_at_.put(i, records[i].x);
        ranks[i] = rank_of(records[i].rank);
      }
      columns.fill(slots_, first, last, listed_at_, ranks.data());
      if (columns.radius == nullptr) return;
      for (std::size_t p = first; p < last; ++p) {
        columns.radius[p] = static_cast<Real>(reach_of(records[slots_.slot_of(p)]));
      }
    });
    build_neighbour_list(cells_, neighbour_rule(columns), search_, list_);
    strike_apart();
    list_.add_empty_segments((end_ + NeighbourList::kSegment - 1) / NeighbourList::kSegment);

    limits_.diameter = 2 * rules_->largest_reach();
    find_coarseness();
    // A thousandth covers what rounding takes of displacements.
    limits_.skin = std::max(0.0, 0.999 * skin_ - 2 * rules_->rounding - coarseness_);
    std::copy(std::begin(rules_->pass.periodic), std::end(rules_->pass.periodic), limits_.periodic);
    // Within a window it does not matter in which order.
    motion_.lay_out({columns.x, columns.y, columns.z}, count, kWindow, limits_);
    // Those without a place are always far from it.
    anchors_.assign((end_ + kWindow - 1) / kWindow, Anchor{{}, {}, Real(-1), {}});
    moved_.resize(anchors_.size());
    strayed_.assign(room / kLanes, 0);
    mended_.clear(strayed_.size());
    released_.clear();
    const std::size_t many = count / kStrayCost + kLanes;  // a list with more strays does not last
    strays_.reserve(many);
    room_.reserve(many);
    mended_.reserve(many);
    age_ = 0;
    spent_ = 0;
    if (builds_ % kFollowTrial == 0) follow_helps_ = true;
    listed_ = true;
    ++builds_;
    follow(records);
  }

  /// The rows of group g of segment s, as good as the list is.
  std::span<const std::uint32_t> rows(std::size_t s, std::size_t g) const {
    return is_mended(s, g) ? mended_.rows(s * kGroups + g) : list_.rows(s, g);
  }
  bool is_mended(std::size_t s, std::size_t g) const { return mended_.holds(s * kGroups + g); }
  const NeighbourList::Segment& segment(std::size_t s) const { return list_.segments[s]; }
  std::size_t segment_count() const { return list_.segments.size(); }
  std::size_t entry_count() const { return list_.entry_count(); }
  std::uint64_t build_count() const { return builds_; }

  /// Where the next particle can be born, at least.
  std::size_t first_free() const { return (count_ + kWindow - 1) / kWindow * kWindow; }
  /// A particle is born in slot i, first_free() or later: a stray from the start. Rows get it when they are mended
  /// next.
  void add(std::size_t i, std::uint32_t rank) {
    if (!listed_) return;
    HOOKE_ASSERT(i >= first_free(), i, first_free());
    if (i >= end_ || rules_->pass.periodic_kind == PeriodicKind::images) return forget();
    order_[i] = rank;
    listed_at_.put(i, {Real(0), Real(0), Real(0)});
    note_far(i / kLanes, 1U << i % kLanes);
  }

  /// These pairs (indices) were kept apart and may touch from now on: rows get them when they are mended next.
  void release(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
    for (const auto& [i, p] : pairs) {
      released_.push_back({i, order_[p], record_offset<Real>(p)});
      released_.push_back({p, order_[i], record_offset<Real>(i)});
    }
  }
  /// Mends rows for what was released or added, where particles have not moved since they were mended last.
  void mend_released(const Record* records) {
    if (listed_) mend(records);
  }

  // Moving ----------------------------------------------------------------------------------------------------------

  const Anchor* anchors() const { return anchors_.data(); }  ///< one a window
  Columns<Real> listed_at() const { return listed_at_.columns(); }
  /// Steps that anchors will have gone once particles have moved by one step more.
  Real next_step() const { return static_cast<Real>(steps_ + 1); }

  /// Takes the lanes of a group that are further from their anchor than it allows: `far` has a bit a lane. Any thread
  /// may call, one a group.
  void note_far(std::size_t group, unsigned far) {
    HOOKE_ASSERT(group < strayed_.size() && far >> kLanes == 0, group, strayed_.size(), far);
    const unsigned news = far & ~unsigned{strayed_[group]};
    if (news == 0) return;
    strayed_[group] = static_cast<std::uint16_t>(strayed_[group] | far);
    const std::lock_guard lock(mutex_);
    for (unsigned left = news; left != 0; left &= left - 1) {
      strays_.push_back(static_cast<std::uint32_t>(group * kLanes) +
                        static_cast<std::uint32_t>(std::countr_zero(left)));
    }
  }
  /// Whether particle i has moved, in its next step, further from its anchor than that allows.
  bool is_far(const Record& p, std::size_t i) const { return is_off(p, i, anchors_[i / kWindow], next_step()); }
  /// All particles have moved by a step, and those that strayed are noted. Says in good() whether the list goes on.
  void moved(const Record* records) {
    if (!listed_) return;
    ++steps_;
    ++age_;
    if (rules_->pass.periodic_kind == PeriodicKind::images && !strays_.empty()) return forget();
    since_followed_ += kStrayCost * strays_.size();
    if (steps_ > horizon_ || (follow_helps_ && since_followed_ * kFollowShare > count_)) {
      const std::size_t before = strays_.size();
      follow(records);
      follow_helps_ = 2 * strays_.size() < before;
    }
    const std::size_t cost = kStrayCost * (strays_.size() + released_.size());
    spent_ += cost;
    // What a step costs falls with the age of a list and rises with its strays: where both meet it has served best.
    if (cost * age_ > count_ + spent_ || is_too_thick()) return forget();
    mend(records);
  }

  /// Pairs that touch and are not on the list, counted the long way; for tests of all this.
  std::uint64_t count_missed(const Record* records) const {
    CellList cells;
    std::vector<std::uint32_t> order;
    lay_out_cells(cells, 0, end_);
    cells.sort(end_, key_of(cells, records), order);
    const StrayPairs<Real> pairs = stray_pairs(records);
    std::atomic<std::uint64_t> missed{0};
    parallel_ranges(end_, kLanes, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        if (is_nowhere(records[i])) continue;
        const auto rows = this->rows(i / NeighbourList::kSegment, i % NeighbourList::kSegment / kLanes);
        cells.for_points_near(vec_cast<double>(records[i].x), reach_of(records[i]), [&](std::size_t k) {
          const std::uint32_t p = order[k];
          if (p != i && pairs.overlap(i, p) && !apart_->hold(rank_of(records[i].rank), rank_of(records[p].rank)) &&
              !is_in_lane(rows, i % kLanes, record_offset<Real>(p)))
            ++missed;
        });
      }
    });
    return missed;
  }

 private:
  // Takes pairs that springs keep apart out of the rows.
  void strike_apart() {
    if (apart_->empty()) return;
    parallel_ranges(count_, kLanes, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const std::span<std::uint32_t> rows = list_.rows_to_edit(i / NeighbourList::kSegment, i / kLanes % kGroups);
        apart_->strike(order_[i], rows.data() + i % kLanes, rows.size() / kLanes, kLanes, filling_,
                       [this](std::uint32_t entry) { return order_[entry / record_offset<Real>(1)]; });
      }
    });
  }

  // Costs, in units of what listing one particle takes.
  static constexpr std::size_t kStrayCost = 6;  // looking after one stray for one step
  static constexpr std::size_t kFollowShare = 9;  // following the particles takes this part of a build

  static constexpr std::uint64_t kFollowTrial = 16;  // builds after which anchors may follow in vain once more

  // Skins as a part of the smallest diameter.
  static constexpr double kFirstSkin = 0.25, kThinnestSkin = 0.06, kThickestSkin = 0.4;
  static constexpr double kBuildOverSkin = 7.4;  // what a build costs over what a skin of one diameter adds to a pass

  double reach_of(const Record& p) const { return rules_->reach_of(static_cast<std::size_t>(p.material)); }

  // The wider the skin, the longer a list lasts, and the longer are its rows: a step costs a s + b r / s, with a what a
  // skin of one diameter adds to a pass, b the cost of a build, s the skin in diameters and r the part of a diameter
  // that neighbours move away from each other in a step. That is least here, with r from what the last list's skin
  // allowed for as long as it lasted.
  double best_skin() const {
    return std::clamp(std::sqrt(kBuildOverSkin * skin_ratio_ / static_cast<double>(age_)), kThinnestSkin,
                      kThickestSkin);
  }
  void choose_skin() {
    if (age_ > 0) {
      skin_ratio_ = 0.5 * (skin_ratio_ + best_skin());
      age_ = 0;
    }
    skin_ = skin_ratio_ * 2 * rules_->smallest_radius;
  }
  // Whether the list has lasted for so long that one with a thinner skin would have been better.
  bool is_too_thick() const { return best_skin() < 0.5 * skin_ratio_; }

  void lay_out_cells(CellList& cells, double skin, std::size_t count) const {
    std::vector<CellList::Level> levels;
    for (const double radius : rules_->level_radius) levels.push_back({radius, 2 * radius + skin});
    cells.lay_out(limits_.min, limits_.max, rules_->pass.periodic, levels, count);
  }
  auto key_of(const CellList& cells, const Record* records) const {
    return [&cells, records, &level_of = rules_->level_of](std::size_t i) {
      const Record& p = records[i];
      if (is_nowhere(p)) return cells.key_end();
      return cells.key_of(vec_cast<double>(p.x), level_of[static_cast<std::size_t>(p.material)]);
    };
  }

  // What a search reads, in cell order. Room for all of it is less than particles take themselves.
  struct SearchColumns {
    Real *x, *y, *z, *radius;  // m; no radius where all are the same
    std::uint32_t* rank;

    SearchColumns(std::span<std::byte> room, std::size_t count, bool radii)
        : x(reinterpret_cast<Real*>(room.data())),
          y(x + count),
          z(y + count),
          radius(radii ? z + count : nullptr),
          rank(reinterpret_cast<std::uint32_t*>(z + count + (radii ? count : 0))) {}

    // One column after the other, each in cell order: `at` (m) and `ranks` are by slot.
    void fill(const WindowOrder& slots, std::size_t first, std::size_t last, const ColumnStore<Real>& at,
              const std::uint32_t* ranks) const {
      const auto copy = [&](const auto* from, auto* to) {
        for (std::size_t p = first; p < last; ++p) to[p] = from[slots.slot_of(p)];
      };
      copy(at.columns().x, x);
      copy(at.columns().y, y);
      copy(at.columns().z, z);
      copy(ranks, rank);
    }
  };

  NeighbourRule<Real> neighbour_rule(const SearchColumns& columns) {
    constexpr double kRounding = 1e-3;
    NeighbourRule<Real> rule;
    rule.at = {columns.x, columns.y, columns.z};
    rule.radius = columns.radius;
    rule.rank = columns.rank;
    rule.place = slots_.places();
    rule.neighbour_count = slots_.neighbour_counts();
    rule.reach = static_cast<Real>(kRounding * rules_->smallest_radius +
                                   (columns.radius == nullptr ? 2 * rules_->largest_reach() : 0) + skin_);
    std::copy(std::begin(rules_->pass.periodic), std::end(rules_->pass.periodic), rule.periodic);
    rule.length = rules_->pass.length;
    rule.list_self = rules_->pass.periodic_kind == PeriodicKind::images;
    rule.stride = record_offset<Real>(1);
    rule.dummy = filling_ / rule.stride;
    return rule;
  }

  // What the rounding of places may take of the motion of two particles: some spacings of numbers as far out as they
  // are.
  void find_coarseness() {
    double furthest = 0;
    for (int axis = 0; axis < 3; ++axis) {
      furthest = std::max({furthest, std::abs(component(limits_.min, axis)), std::abs(component(limits_.max, axis))});
    }
    coarseness_ = 8 * static_cast<double>(std::numeric_limits<Real>::epsilon()) * furthest;
  }

  // How far a record has moved since its neighbours were listed, beyond `expected`, m.
  Vec3<Real> displacement(const Record& p, std::size_t i, const Vec3<Real>& expected) const {
    const ForcePass<Real>& pass = rules_->pass;
    const Vec3<Real> from = listed_at_[i] + expected;
    Vec3<Real> moved = p.x - from;
    for (int axis = 0; axis < 3; ++axis) {
      if (!pass.periodic[axis]) continue;
      const Real now = component(p.x, axis), then = component(from, axis);
      const Real length = component(pass.length, axis);
      component(moved, axis) = image_displacement(now, then, nearest_image(now, then, length), length);
    }
    return moved;
  }
  bool is_off(const Record& p, std::size_t i, const Anchor& anchor, Real steps) const {
    const Vec3<Real> off = displacement(p, i, anchor.at(steps));
    return !(dot(off, off) <= anchor.limit2(steps));
  }

  // Makes anchors follow the particles, and finds out who strays from where they are now.
  void follow(const Record* records) {
    using GroupMotion = typename MotionBounds<Real>::GroupMotion;
    const Real dt = rules_->pass.dt;
    horizon_ = motion_.follow(
        [&](std::size_t w) {
          GroupMotion motion;
          Extent extent;
          for (std::size_t i = w * kWindow; i < std::min((w + 1) * kWindow, count_); ++i) {
            if (is_nowhere(records[i])) continue;
            const Vec3<Real> u = displacement(records[i], i, {Real(0), Real(0), Real(0)});
            extent.add(u);
            motion.moved += u;
            motion.step += dt * records[i].v;
            motion.count = motion.count + Real(1);
          }
          moved_[w] = extent;
          return motion;
        },
        anchors_);
    steps_ = 0;
    since_followed_ = 0;
    strays_.clear();
    if (horizon_ < 0) return forget();
    parallel_ranges(strayed_.size(), kGroups, [&](std::size_t first, std::size_t last) {
      for (std::size_t g = first; g < last; ++g) {
        strayed_[g] = 0;
        note_far(g, strays_of_group(records, g));
      }
    });
  }

  // Those that stray from where their anchor is now, and those born since, a bit a lane.
  unsigned strays_of_group(const Record* records, std::size_t g) const {
    const std::size_t window = g * kLanes / kWindow;
    const Anchor& anchor = anchors_[window];
    const bool born = g * kLanes >= first_free();
    unsigned far = 0;
    if (!born && moved_[window].furthest2(anchor.offset) <= anchor.limit2(Real(0))) return far;
    const std::size_t end = born ? (g + 1) * kLanes : std::min((g + 1) * kLanes, count_);
    for (std::size_t i = g * kLanes; i < end; ++i) {
      if (!is_nowhere(records[i]) && (born || is_off(records[i], i, anchor, Real(0)))) far |= 1U << i % kLanes;
    }
    return far;
  }

  StrayPairs<Real> stray_pairs(const Record* records) const {
    return {*rules_, records, cells_, slots_, order_.data(), list_, *apart_};
  }

  // Finds the pairs of strays that touch and rows that lack them.
  void mend(const Record* records) {
    mended_.clear(strayed_.size());
    if (strays_.empty() && released_.empty()) return;
    const auto steps = static_cast<Real>(steps_);
    const double mild = MotionBounds<Real>::kMild * limits_.skin, half = 0.5 * skin_ + coarseness_;
    const Vec3<Real> middle = motion_.middle(steps);
    const double anywhere = half + motion_.furthest_from_middle(static_cast<double>(steps_));
    const auto place_of = [&](std::size_t i) -> typename StrayPairs<Real>::Place {
      if (i >= count_) return {vec_cast<double>(records[i].x - middle), anywhere};
      const Anchor& anchor = anchors_[i / kWindow];
      const Vec3<Real> off = displacement(records[i], i, anchor.at(steps));
      if (static_cast<double>(dot(off, off)) < mild * mild) {
        return {vec_cast<double>(records[i].x - anchor.at(steps)), half + motion_.anchors_apart(anchor, steps)};
      }
      return {vec_cast<double>(records[i].x - middle), anywhere};
    };
    if (!stray_pairs(records).find(strays_, strayed_, place_of, filling_, released_, room_, mended_)) forget();
  }

  // Bounds of the displacements of a window, m.
  struct Extent {
    static constexpr Real kInfinite = std::numeric_limits<Real>::infinity();
    Vec3<Real> low{kInfinite, kInfinite, kInfinite}, high{-kInfinite, -kInfinite, -kInfinite};

    void add(const Vec3<Real>& u) {
      low = {std::min(low.x, u.x), std::min(low.y, u.y), std::min(low.z, u.z)};
      high = {std::max(high.x, u.x), std::max(high.y, u.y), std::max(high.z, u.z)};
    }
    // No point of it is further from `from`; NaN where there is doubt.
    Real furthest2(const Vec3<Real>& from) const {
      if (low.x > high.x) return Real(0);
      const auto most = [](Real a, Real b) { return a < b ? b : a; };
      const Vec3<Real> off{most(high.x - from.x, from.x - low.x), most(high.y - from.y, from.y - low.y),
                           most(high.z - from.z, from.z - low.z)};
      return dot(off, off);
    }
  };

  const PassRules<Real>* rules_ = nullptr;
  WindowSearchFunction<Real> search_ = nullptr;
  const ApartPairs* apart_ = nullptr;
  double skin_ratio_ = kFirstSkin, skin_ = 0;  // of the smallest diameter; m
  double coarseness_ = 0;  // m

  std::size_t count_ = 0;  // listed
  std::size_t end_ = 0;  // of the room for those born since
  std::uint32_t filling_ = 0;  // of short lanes: an entry
  CellList cells_;
  WindowOrder slots_;
  std::vector<std::uint32_t> order_;  // while sorting: where each was before; then: ranks
  NeighbourList list_;
  ColumnStore<Real> listed_at_;  // m
  bool listed_ = false;
  std::uint64_t builds_ = 0;

  typename MotionBounds<Real>::Limits limits_;
  MotionBounds<Real> motion_;
  std::vector<Anchor> anchors_;  // by window
  std::vector<Extent> moved_;  // likewise
  std::vector<std::uint16_t> strayed_;  // by group: a bit a lane
  MendedRows mended_;
  std::vector<std::uint32_t> strays_;
  std::vector<MendedRows::Lack> released_;  // what rows lack of pairs that were kept apart when they were listed
  typename StrayPairs<Real>::Room room_;
  std::mutex mutex_;  // around strays_
  std::int64_t steps_ = 0, horizon_ = 0;  // since anchors followed last; how many they are good for
  bool follow_helps_ = true;  // against strays, as far as is known
  std::size_t age_ = 0;  // steps since the last build
  std::size_t since_followed_ = 0, spent_ = 0;  // on strays, since anchors followed and since the last build
};

}  // namespace hooke
