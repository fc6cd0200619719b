// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The search for neighbours, written once and compiled once for each instruction set (HOOKE_ISA). Points of a block are
// compared with a pack of others at a time; then the rows of 16 points are sorted by rank side by side, one a lane.

#include <limits>

#include "hooke/backends/cpu/pack.h"
#include "hooke/neighbours/group_search.h"

namespace hooke::HOOKE_ISA {
namespace {

constexpr std::size_t kRowLanes = 16;
constexpr std::int32_t kLastRank = std::numeric_limits<std::int32_t>::max();

template <class Real, bool kOneRadius, bool kPeriodic>
class Search {
  using P = Pack<Real>;

 public:
  HOOKE_HD Search(const NeighbourRule<Real>& rule, const GroupSearch<Real>& group) : rule_(rule), group_(group) {}

  HOOKE_HD std::size_t run() {
    std::uint32_t i = group_.first;
    for (std::size_t b = 0; b < group_.block_count; ++b) {
      const std::size_t count = gather(group_.blocks[b]);
      for (; i < group_.blocks[b].last; ++i) put_into_lane(i, find_near(i, count));
    }
    sort_rows();
    return rows_;
  }

 private:
  // Copies the block's ranges behind each other, whole packs: what is too much is overwritten by the next one.
  HOOKE_HD std::size_t gather(const SearchBlock& block) const {
    std::size_t to = 0;
    for (std::uint32_t r = 0; r < block.range_count; ++r) {
      for (std::size_t p = block.from[r]; p < block.to[r]; p += P::kLanes) {
        const std::size_t at = to + p - block.from[r];
        const Vec3<P> x = positions(p);
        store(group_.x + at, x.x);
        store(group_.y + at, x.y);
        store(group_.z + at, x.z);
        if constexpr (!kOneRadius) store(group_.radius + at, load(rule_.radius + p));
        for (std::size_t lane = 0; lane < P::kLanes; ++lane) {
          group_.index[at + lane] = static_cast<std::int32_t>(p + lane);
        }
      }
      to += block.to[r] - block.from[r];
    }
    constexpr Real kFar = Real(-1e18);  // not where removed particles are, which would find it
    store(group_.x + to, P(kFar));  // fills the last pack
    return to;
  }

  HOOKE_HD Vec3<P> positions(std::size_t first) const {
    if (rule_.at.x != nullptr) return {load(rule_.at.x + first), load(rule_.at.y + first), load(rule_.at.z + first)};
    const Quad<Real> q = load_quads(
        Real{}, [=, this](int lane) { return rule_.records + 8 * (first + static_cast<std::size_t>(lane)); });
    return {q.a, q.b, q.c};
  }
  HOOKE_HD Vec3<P> position(std::uint32_t i) const {
    if (rule_.at.x != nullptr) return {P(rule_.at.x[i]), P(rule_.at.y[i]), P(rule_.at.z[i])};
    const Real* record = rule_.records + 8 * std::size_t{i};
    return {P(record[0]), P(record[1]), P(record[2])};
  }

  // The number of those near point i, itself perhaps included; their indices go to group_.found.
  HOOKE_HD std::size_t find_near(std::uint32_t i, std::size_t count) const {
    const Vec3<P> own = position(i);
    P reach(rule_.reach);
    if constexpr (!kOneRadius) reach = reach + P(rule_.radius[i]);
    const P reach2 = reach * reach;
    std::size_t found = 0;
    for (std::size_t c = 0; c < count; c += P::kLanes) {
      const Vec3<P> d{displacement(own.x, load(group_.x + c), 0), displacement(own.y, load(group_.y + c), 1),
                      displacement(own.z, load(group_.z + c), 2)};
      P limit2 = reach2;
      if constexpr (!kOneRadius) {
        const P sum = reach + load(group_.radius + c);
        limit2 = sum * sum;
      }
      found += append_where_less(group_.found + found, group_.index + c, dot(d, d), limit2);
    }
    return found;
  }

  HOOKE_HD P displacement(const P& x_i, const P& x_p, int axis) const {
    const P d = x_i - x_p;
    if (!kPeriodic || !rule_.periodic[axis]) return d;
    const P length(component(rule_.length, axis));
    const P half = P(Real(0.5)) * length;
    return select(d > half, d - length, select(d < -half, d + length, d));
  }

  HOOKE_HD void put_into_lane(std::uint32_t i, std::size_t found) {
    const std::size_t lane = i - group_.first;
    for (; cleared_ <= found; ++cleared_) {
      for (std::size_t k = 0; k < kRowLanes; ++k) {
        group_.ranks[cleared_ * kRowLanes + k] = kLastRank;
        group_.entries[cleared_ * kRowLanes + k] = rule_.dummy;
      }
    }
    const std::int32_t self = rule_.list_self ? -1 : static_cast<std::int32_t>(i);
    std::size_t row = 0;
    for (std::size_t k = 0; k < found; ++k) {  // the point itself is written, and the next one over it
      const std::int32_t index = group_.found[k];
      group_.ranks[row * kRowLanes + lane] = static_cast<std::int32_t>(rule_.rank[index]);
      group_.entries[row * kRowLanes + lane] = static_cast<std::uint32_t>(index) * rule_.stride;
      row += index != self ? 1 : 0;
    }
    group_.ranks[row * kRowLanes + lane] = kLastRank;
    group_.entries[row * kRowLanes + lane] = rule_.dummy;
    if (row > rows_) rows_ = row;
  }

  // Batcher's merge exchange (Knuth, The Art of Computer Programming, 5.2.2, algorithm M), all lanes at once.
  HOOKE_HD void sort_rows() const {
    std::size_t top = 1;
    while (2 * top < rows_) top *= 2;
    for (std::size_t p = top; p > 0; p /= 2) {
      std::size_t q = top, r = 0, d = p;
      for (;;) {
        for (std::size_t row = 0; row + d < rows_; ++row) {
          if ((row & p) == r) sort_pair(row, row + d);
        }
        if (q == p) break;
        d = q - p;
        q /= 2;
        r = p;
      }
    }
  }

  HOOKE_HD void sort_pair(std::size_t a, std::size_t b) const {
    for (std::size_t lane = 0; lane < kRowLanes; lane += kInt32Lanes) {
      sort_lanes(group_.ranks + a * kRowLanes + lane, group_.ranks + b * kRowLanes + lane,
                 group_.entries + a * kRowLanes + lane, group_.entries + b * kRowLanes + lane);
    }
  }

  // Copies: the compiler need not read them again after every store.
  const NeighbourRule<Real> rule_;
  const GroupSearch<Real> group_;
  std::size_t cleared_ = 0;  // rows
  std::size_t rows_ = 0;
};

template <class Real, bool kOneRadius>
std::size_t choose_periodic(const NeighbourRule<Real>& rule, const GroupSearch<Real>& group) {
  const bool periodic = rule.periodic[0] || rule.periodic[1] || rule.periodic[2];
  return periodic ? Search<Real, kOneRadius, true>(rule, group).run()
                  : Search<Real, kOneRadius, false>(rule, group).run();
}

template <class Real>
std::size_t choose_radius(const NeighbourRule<Real>& rule, const GroupSearch<Real>& group) {
  return rule.radius == nullptr ? choose_periodic<Real, true>(rule, group) : choose_periodic<Real, false>(rule, group);
}

}  // namespace

std::size_t search_group(const NeighbourRule<float>& rule, const GroupSearch<float>& group) {
  return choose_radius(rule, group);
}
std::size_t search_group(const NeighbourRule<double>& rule, const GroupSearch<double>& group) {
  return choose_radius(rule, group);
}

}  // namespace hooke::HOOKE_ISA
