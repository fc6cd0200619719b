// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/verlet_list.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <iterator>

#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"

namespace hooke {

template <class Real>
auto VerletList<Real>::key_of(const CellList& cells, const Record* records) const {
  return [&cells, records, &level_of = rules_->level_of()](std::size_t i) {
    const Record& p = records[i];
    if (is_vacant(p)) return cells.key_end();
    return cells.key_of(vec_cast<double>(p.x), level_of[static_cast<std::size_t>(p.material)]);
  };
}

template <class Real>
std::span<const std::uint32_t> VerletList<Real>::sort(const Record* records, std::size_t count, const Box3d& box,
                                                      std::span<std::byte> scratch) {
  choose_skin();
  limits_.min = box.min;
  limits_.max = box.max;
  lay_out_cells(cells_, skin_, count);
  cells_.sort(count, key_of(cells_, records), order_, scratch);
  slots_.lay_out(std::span(order_).first(cells_.point_count()));
  return order_;
}

template <class Real>
std::span<const std::uint32_t> VerletList<Real>::sort_ghosts(const Record* records, std::size_t first,
                                                             std::size_t end) {
  const auto key = key_of(ghost_cells_, records + first);
  lay_out_cells(ghost_cells_, skin_, end - first);
  ghost_cells_.sort(
      end - first,
      [&](std::size_t i) {
        const bool touches = rules_->interacts(static_cast<std::size_t>(records[first + i].material));
        return touches ? key(i) : ghost_cells_.key_end();
      },
      ghost_order_);
  first_ghost_ = first;
  ghost_end_ = first + ghost_cells_.point_count();
  return ghost_order_;
}

template <class Real>
void VerletList<Real>::build(const Record* records, std::size_t count, std::size_t end, std::size_t size,
                             std::span<std::byte> scratch) {
  HOOKE_ASSERT(std::max(count, end) < size, count, end, size);
  HOOKE_ASSERT(scratch.size() >= size * sizeof(Record), scratch.size(), size);
  count_ = count;
  end_ = std::max(count, end);
  filler_ = record_offset<Real>(static_cast<std::uint32_t>(size - 1));
  const std::size_t room = (known_end() + kLanes - 1) / kLanes * kLanes;
  position_at_build_.resize(room);
  std::vector<std::uint32_t>& id_indices = order_;  // the order of the sort is no longer needed
  id_indices.reserve(room);  // a growing vector would take twice that
  id_indices.resize(room);
  const std::size_t points = has_ghosts() ? ghost_end_ : count;
  const SearchColumns columns(scratch, points + kLanes, rules_->largest_touching() > rules_->smallest_touching());
  parallel_ranges(count, NeighbourList::kTile, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      position_at_build_.put(i, records[i].x);
      id_indices[i] = id_index_of(records[i].id_index);
    }
    columns.fill(slots_, first, last, position_at_build_, id_indices.data());
    if (columns.radius == nullptr) return;
    for (std::size_t p = first; p < last; ++p) {
      columns.radius[p] = static_cast<Real>(interaction_radius(records[slots_.slot_of(p)]));
    }
  });
  if (has_ghosts()) add_ghosts(records, columns);
  build_neighbour_list(cells_, neighbour_rule(columns), search_, list_, ghost_points());
  strike_exclusions();
  list_.add_empty_tiles((known_end() + NeighbourList::kTile - 1) / NeighbourList::kTile);

  limits_.diameter = 2 * rules_->largest_interaction_radius();
  find_coarseness();
  // A thousandth covers the rounding of displacements.
  limits_.skin = std::max(0.0, 0.999 * skin_ - 2 * rules_->rounding() - coarseness_);
  std::copy(std::begin(rules_->view().periodic), std::end(rules_->view().periodic), limits_.periodic);
  // The order within a window does not matter.
  motion_.lay_out({columns.x, columns.y, columns.z}, points, kWindow, limits_);
  // Slots after the last particle are always far (buffer -1).
  frames_.assign((known_end() + kWindow - 1) / kWindow, Frame{{}, {}, Real(-1), {}});
  moved_.resize(frames_.size());
  outlying_.assign(room / kLanes, 0);
  patched_.clear(outlying_.size());
  released_.clear();
  patching_due_ = false;
  fresh_.clear();
  room_.missing.clear();
  const std::size_t many = count / kOutlierCost + kLanes;  // a list with more outliers does not last
  outliers_.reserve(many);
  room_.reserve(many);
  patched_.reserve(many);
  age_ = 0;
  spent_ = 0;
  excess_ = 0;
  if (builds_ % kFollowTrial == 0) follow_helps_ = true;
  listed_ = true;
  ++builds_;
  follow(records);
}

// Puts ghosts into what a search reads. Columns between the particles and the ghosts are those of a ghost: no search
// finds them, and reference frames need numbers.
template <class Real>
void VerletList<Real>::add_ghosts(const Record* records, const SearchColumns& columns) {
  slots_.add_in_order(first_ghost_, ghost_end_);
  for (std::size_t i = count_; i < ghost_end_; ++i) {
    const Record& p = records[std::max(i, first_ghost_)];
    position_at_build_.put(i, p.x);
    order_[i] = id_index_of(p.id_index);
    columns.x[i] = p.x.x;
    columns.y[i] = p.x.y;
    columns.z[i] = p.x.z;
    columns.id_index[i] = order_[i];
    if (columns.radius != nullptr) columns.radius[i] = static_cast<Real>(interaction_radius(p));
  }
}

template <class Real>
void VerletList<Real>::note_far_ghosts(const Record* records) {
  if (!listed_ || !has_ghosts()) return;
  for (std::size_t first = first_ghost_; first < ghost_end_; first += kLanes) {
    const Frame& frame = frames_[first / kWindow];
    const Vec3<Real> expected = frame.at(next_step());
    const std::size_t count = end_from(first, kLanes) - first;
    // The numbers of all lanes first, and the decisions then: a loop without branches runs on several lanes at a time.
    std::array<Real, kLanes> off2;
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Vec3<Real> off = displacement(records[first + lane], first + lane, expected);
      off2[lane] = dot(off, off);
    }
    const Real limit2 = frame.limit2(next_step());
    unsigned far = 0;
    for (std::size_t lane = 0; lane < count; ++lane) {
      if (!(off2[lane] <= limit2) && !is_vacant(records[first + lane])) far |= 1U << lane;
    }
    if (far != 0) note_far(first / kLanes, far);
  }
}

template <class Real>
void VerletList<Real>::note_far(std::size_t slice, unsigned far) {
  HOOKE_ASSERT(slice < outlying_.size() && far >> kLanes == 0, slice, outlying_.size(), far);
  const unsigned news = far & ~unsigned{outlying_[slice]};
  if (news == 0) return;
  outlying_[slice] = static_cast<std::uint16_t>(outlying_[slice] | far);
  const std::lock_guard lock(mutex_);
  for (unsigned left = news; left != 0; left &= left - 1) {
    outliers_.push_back(static_cast<std::uint32_t>(slice * kLanes) +
                        static_cast<std::uint32_t>(std::countr_zero(left)));
  }
}

template <class Real>
void VerletList<Real>::moved(const Record* records) {
  if (!listed_) {
    if (is_shared_) ++age_;  // the same on all ranks
    return;
  }
  ++steps_;
  ++age_;
  if (rules_->view().periodic_kind == PeriodicKind::images && !outliers_.empty()) return invalidate();
  since_followed_ += kOutlierCost * outliers_.size();
  if (steps_ > horizon_ || (follow_helps_ && since_followed_ * kFollowShare > count_)) {
    const std::size_t before = outliers_.size();
    follow(records);
    follow_helps_ = 2 * outliers_.size() < before;
  }
  const std::size_t cost = kOutlierCost * (outliers_.size() + released_.size());
  spent_ += cost;
  // The mean cost of a step, (count + spent) / age, is least where it meets the rising cost of a single step.
  excess_ = static_cast<std::int64_t>(cost * age_) - static_cast<std::int64_t>(count_ + spent_);
  if ((excess_ > 0 && !is_shared_) || is_too_thick()) return invalidate();
  patch(records);
}

template <class Real>
std::uint64_t VerletList<Real>::count_missed(const Record* records) const {
  CellList cells;
  std::vector<std::uint32_t> order;
  lay_out_cells(cells, 0, known_end());
  const auto key = key_of(cells, records);
  cells.sort(known_end(), [&](std::size_t i) { return i < end_ || is_ghost(i) ? key(i) : cells.key_end(); }, order);
  const OutlierPairs<Real> pairs = outlier_pairs(records);
  std::atomic<std::uint64_t> missed{0};
  parallel_ranges(end_, kLanes, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (is_vacant(records[i])) continue;
      const auto rows = this->rows(i / NeighbourList::kTile, i % NeighbourList::kTile / kLanes);
      cells.for_points_near(vec_cast<double>(records[i].x), interaction_radius(records[i]), [&](std::size_t k) {
        const std::uint32_t p = order[k];
        if (p != i && pairs.overlap(i, p) &&
            !exclusions_->hold(id_index_of(records[i].id_index), id_index_of(records[p].id_index)) &&
            !is_in_lane(rows, i % kLanes, record_offset<Real>(p)))
          ++missed;
      });
    }
  });
  return missed;
}

// Removes the pairs that springs keep apart from the rows.
template <class Real>
void VerletList<Real>::strike_exclusions() {
  if (exclusions_->empty()) return;
  parallel_ranges(count_, kLanes, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const std::span<std::uint32_t> rows = list_.rows_to_edit(i / NeighbourList::kTile, i / kLanes % kSlices);
      exclusions_->strike(order_[i], rows.data() + i % kLanes, rows.size() / kLanes, kLanes, filler_,
                          [this](std::uint32_t entry) { return order_[entry / record_offset<Real>(1)]; });
    }
  });
}

// A wider skin makes a list last longer, but also makes its rows longer: a step costs a s + b r / s, with a the cost
// that a skin of one diameter adds to a pass, b the cost of a build, s the skin in diameters and r the diameters that
// neighbours move away from each other in a step. Returns the s of least cost, with r the skin of the last list over
// its age.
template <class Real>
double VerletList<Real>::best_skin() const {
  return std::clamp(std::sqrt(kBuildOverSkin * skin_ratio_ / static_cast<double>(age_)), kThinnestSkin, kThickestSkin);
}

template <class Real>
void VerletList<Real>::choose_skin() {
  if (age_ > 0) {
    skin_ratio_ = 0.5 * (skin_ratio_ + best_skin());
    age_ = 0;
  }
  skin_ = skin_ratio_ * 2 * rules_->smallest_touching();
}

template <class Real>
void VerletList<Real>::lay_out_cells(CellList& cells, double skin, std::size_t count) const {
  std::vector<CellList::Level> levels;
  for (const double radius : rules_->level_radius()) levels.push_back({radius, 2 * radius + skin});
  cells.lay_out(limits_.min, limits_.max, rules_->view().periodic, levels, count);
}

template <class Real>
NeighbourRule<Real> VerletList<Real>::neighbour_rule(const SearchColumns& columns) {
  constexpr double kRounding = 1e-3;
  NeighbourRule<Real> rule;
  rule.at = {columns.x, columns.y, columns.z};
  rule.radius = columns.radius;
  rule.id_index = columns.id_index;
  rule.slot_in_window = slots_.places();
  rule.neighbour_count = slots_.neighbour_counts();
  rule.reach = static_cast<Real>(kRounding * rules_->smallest_touching() +
                                 (columns.radius == nullptr ? 2 * rules_->largest_interaction_radius() : 0) + skin_);
  std::copy(std::begin(rules_->view().periodic), std::end(rules_->view().periodic), rule.periodic);
  rule.length = rules_->view().length;
  rule.list_self = rules_->view().periodic_kind == PeriodicKind::images;
  rule.stride = record_offset<Real>(1);
  rule.filler = filler_ / rule.stride;
  return rule;
}

// A bound on the rounding of the displacements of two particles: a few spacings of numbers as large as their
// coordinates.
template <class Real>
void VerletList<Real>::find_coarseness() {
  double furthest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    furthest = std::max({furthest, std::abs(component(limits_.min, axis)), std::abs(component(limits_.max, axis))});
  }
  coarseness_ = 8 * static_cast<double>(std::numeric_limits<Real>::epsilon()) * furthest;
}

// Makes reference frames follow the particles, and finds the present outliers.
template <class Real>
void VerletList<Real>::follow(const Record* records) {
  using WindowMotion = typename MotionBounds<Real>::WindowMotion;
  const Real dt = rules_->view().dt;
  horizon_ = motion_.follow(
      [&](std::size_t w) {
        WindowMotion motion;
        Box3<Real> extent = Box3<Real>::none();
        for (std::size_t i = w * kWindow; i < end_from(w * kWindow, kWindow); ++i) {
          if (is_vacant(records[i])) continue;
          const Vec3<Real> u = displacement(records[i], i, {Real(0), Real(0), Real(0)});
          extent.add(u);
          motion.moved += u;
          motion.step += dt * records[i].v;
          motion.count = motion.count + Real(1);
        }
        moved_[w] = extent;
        return motion;
      },
      frames_);
  steps_ = 0;
  since_followed_ = 0;
  outliers_.clear();
  if (horizon_ < 0 && count_ > 0) return invalidate();
  parallel_ranges(outlying_.size(), kSlices, [&](std::size_t first, std::size_t last) {
    for (std::size_t g = first; g < last; ++g) {
      outlying_[g] = 0;
      note_far(g, outliers_of_slice(records, g));
    }
  });
}

// The outliers of a slice by its present reference frame, and the particles born since the build, one bit per lane.
template <class Real>
unsigned VerletList<Real>::outliers_of_slice(const Record* records, std::size_t g) const {
  const std::size_t window = g * kLanes / kWindow;
  const Frame& frame = frames_[window];
  const bool born = g * kLanes >= first_free() && !is_ghost(g * kLanes);
  unsigned far = 0;
  if (!born && furthest2(moved_[window], frame.offset) <= frame.limit2(Real(0))) return far;
  const std::size_t end = born ? std::min((g + 1) * kLanes, end_) : end_from(g * kLanes, kLanes);
  for (std::size_t i = g * kLanes; i < end; ++i) {
    if (!is_vacant(records[i]) && (born || is_off(records[i], i, frame, Real(0)))) far |= 1U << i % kLanes;
  }
  return far;
}

// Around which point the particles that touch a particle were listed, and how far from it at most.
template <class Real>
auto VerletList<Real>::centre_of(const Record* records) const {
  using Centre = typename OutlierPairs<Real>::SearchCentre;
  const auto steps = static_cast<Real>(steps_);
  const double mild = MotionBounds<Real>::kMild * limits_.skin, half = 0.5 * skin_ + coarseness_;
  const Vec3<Real> middle = motion_.middle(steps);
  const double anywhere = half + motion_.furthest_from_middle(static_cast<double>(steps_));
  return [=, this](std::size_t i) -> Centre {
    if (i < count_ || is_ghost(i)) {
      const Frame& frame = frames_[i / kWindow];
      const Vec3<Real> off = displacement(records[i], i, frame.at(steps));
      if (static_cast<double>(dot(off, off)) < mild * mild) {
        return {vec_cast<double>(records[i].x - frame.at(steps)), half + motion_.frames_apart(frame, steps)};
      }
    }
    return {vec_cast<double>(records[i].x - middle), anywhere};
  };
}

// Finds the touching pairs of outliers, and patches the rows that lack them.
template <class Real>
void VerletList<Real>::patch(const Record* records) {
  patching_due_ = false;
  fresh_.clear();
  patched_.clear(outlying_.size());
  room_.missing.clear();
  if (outliers_.empty() && released_.empty()) return;
  if (!outlier_pairs(records).find(outliers_, outlying_, centre_of(records), filler_, released_, room_, patched_)) {
    invalidate();
  }
}

// The same for the outliers that are new since then.
template <class Real>
void VerletList<Real>::patch_fresh(const Record* records) {
  patched_.clear(outlying_.size());
  if (!outlier_pairs(records).add(fresh_, outliers_, outlying_, centre_of(records), filler_, room_, patched_)) {
    invalidate();
  }
  fresh_.clear();
}

template class VerletList<float>;
template class VerletList<double>;

}  // namespace hooke
