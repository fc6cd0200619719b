// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The search for neighbours, written once and compiled once for each instruction set (HOOKE_ISA). Points of a block are
// compared with a pack of others at a time; then the rows of each slice are sorted by id index side by side, one a
// lane.

#include <utility>

#include "hooke/backends/cpu/pack_search.h"
#include "hooke/neighbours/row_network.h"
#include "hooke/neighbours/window_search.h"

namespace hooke::HOOKE_ISA {
namespace {

constexpr std::size_t kSlices = kWindow / kSliceLanes;
constexpr std::size_t kTogether = kPackBytes == 64 ? 4 : kPackBytes == 32 ? 2 : 1;  // points that registers hold

// A neighbour's id index and slot in one number that sorts like the id index: the bits of doubles of 1 and above.
constexpr std::uint32_t kOne = 0x3ff00000U;
HOOKE_HD std::uint64_t row_key(std::uint32_t id_index, std::uint32_t slot) {
  return std::uint64_t{kOne + id_index} << 32U | slot;
}

HOOKE_HD void exchange_rows(Pack<double>& a, Pack<double>& b) {
  const Pack<double> low = min_of(a, b);
  b = max_of(a, b);
  a = low;
}

// Sorts so few rows that registers hold them.
template <std::size_t kRows>
struct RowsInRegisters {
  template <std::size_t... kPair, std::size_t... kRow>
  HOOKE_HD static void sort(std::uint64_t* keys, std::index_sequence<kPair...>, std::index_sequence<kRow...>) {
    [[maybe_unused]] constexpr auto kPairs = RowNetwork<kRows>::pairs();
    for (std::size_t lane = 0; lane < kSliceLanes; lane += Pack<double>::kLanes) {
      Pack<double> row[kRows] = {load_bits(keys + kRow * kSliceLanes + lane)...};
      (exchange_rows(row[kPairs.of[kPair].a], row[kPairs.of[kPair].b]), ...);
      (store_bits(keys + kRow * kSliceLanes + lane, row[kRow]), ...);
    }
  }
  static void sort_rows(std::uint64_t* keys) {
    sort(keys, std::make_index_sequence<RowNetwork<kRows>::count()>(), std::make_index_sequence<kRows>());
  }
};

template <std::size_t... kRows>
void sort_rows_by_network(std::uint64_t* keys, std::size_t rows, std::index_sequence<kRows...>) {
  using Sort = void (*)(std::uint64_t*);
  static constexpr Sort kSorts[] = {RowsInRegisters<kRows + 1>::sort_rows...};
  kSorts[rows - 1](keys);
}

void sort_rows(std::uint64_t* keys, std::size_t rows) {
  if (rows < 2) return;
  constexpr std::size_t kMostInRegisters = 16;
  if (rows <= kMostInRegisters) return sort_rows_by_network(keys, rows, std::make_index_sequence<kMostInRegisters>());
  merge_exchange(rows, [&](std::size_t a, std::size_t b) {
    for (std::size_t lane = 0; lane < kSliceLanes; lane += Pack<double>::kLanes) {
      std::uint64_t* const at_a = keys + a * kSliceLanes + lane;
      std::uint64_t* const at_b = keys + b * kSliceLanes + lane;
      Pack<double> row_a = load_bits(at_a), row_b = load_bits(at_b);
      exchange_rows(row_a, row_b);
      store_bits(at_a, row_a);
      store_bits(at_b, row_b);
    }
  });
}

HOOKE_HD WordVector ascending_words() {
  WordVector words;
  for (std::size_t lane = 0; lane < Pack<double>::kLanes; ++lane) words[lane] = static_cast<std::uint32_t>(lane);
  return words;
}

template <class Real, bool kOneRadius, bool kPeriodic>
class Search {
  using P = Pack<Real>;

 public:
  HOOKE_HD Search(const NeighbourRule<Real>& rule, const WindowSearch<Real>& window) : rule_(rule), window_(window) {}

  HOOKE_HD void run() {
    Slice slices[kSlices];
    for (std::size_t g = 0; g < kSlices; ++g) slices[g].rows = window_.rows + g * window_.row_room * kSliceLanes;
    const SearchRange* ranges = window_.ranges;
    std::uint32_t i = window_.first;
    for (const SearchBlock<Real>* at = window_.blocks; i < window_.end; ++at) {
      const SearchBlock<Real>& block = *at;
      middle_ = {P(block.middle.x), P(block.middle.y), P(block.middle.z)};
      const std::size_t count = gather(ranges, ranges + block.range_count);
      for (; i + kTogether <= block.last; i += kTogether) list_near<kTogether>(i, count, slices);
      if constexpr (kTogether > 2) {
        for (; i + 2 <= block.last; i += 2) list_near<2>(i, count, slices);
      }
      for (; i < block.last; ++i) list_near<1>(i, count, slices);
      ranges += block.range_count;
    }
    for (const Slice& slice : slices) write_rows(slice);
  }

 private:
  // The rows of a slice as they are filled.
  struct Slice {
    std::uint64_t* rows = nullptr;
    std::size_t count = 0;  // of rows
    std::size_t cleared = 0;  // of rows
  };

  // Copies the ranges one after the other in whole packs; the next range overwrites what is too much. Sixteen points
  // far away follow.
  HOOKE_HD std::size_t gather(const SearchRange* range, const SearchRange* end) const {
    std::size_t to = 0;
    for (; range != end; ++range) {
      for (std::size_t p = range->from; p < range->to; p += P::kLanes) {
        const std::size_t at = to + p - range->from;
        const Vec3<P> x = from_middle(positions(p));
        P square = dot(x, x);
        if constexpr (!kOneRadius) {
          const P radius = load(rule_.radius + p);
          square = square - radius * radius;
          store(radius_ + at, radius);
        }
        store(x_ + at, x.x);
        store(y_ + at, x.y);
        store(z_ + at, x.z);
        store(square_ + at, square);
        put_keys(at, p);
      }
      to += range->to - range->from;
    }
    constexpr Real kFar = Real(1e36);
    for (std::size_t at = to; at < to + kSliceLanes; at += P::kLanes) {
      for (Real* column : {x_, y_, z_}) store(column + at, P(Real(0)));
      if constexpr (!kOneRadius) store(radius_ + at, P(Real(0)));
      store(square_ + at, P(kFar));
    }
    return to;
  }

  // Keys of a pack of points from p on. SSE2 has no half registers worth using.
  HOOKE_HD void put_keys(std::size_t at, std::size_t p) const {
    if constexpr (kPackBytes > 16) {
      for (std::size_t lane = 0; lane < P::kLanes; lane += Pack<double>::kLanes) {
        const WordVector id_indices = load_words(rule_.id_index + p + lane) + kOne;
        const WordVector window = (ascending_words_ + static_cast<std::uint32_t>(p + lane)) & ~kInWindow;
        store_bits(keys_ + at + lane, join_halves(id_indices, window | load_bytes(rule_.slot_in_window + p + lane)));
      }
    } else {
      for (std::size_t lane = 0; lane < P::kLanes; ++lane) {
        keys_[at + lane] = row_key(rule_.id_index[p + lane], slot_of(static_cast<std::uint32_t>(p + lane)));
      }
    }
  }

  HOOKE_HD std::uint32_t slot_of(std::uint32_t p) const { return (p & ~kInWindow) | rule_.slot_in_window[p]; }
  HOOKE_HD Vec3<P> positions(std::size_t first) const {
    return {load(rule_.at.x + first), load(rule_.at.y + first), load(rule_.at.z + first)};
  }
  HOOKE_HD Vec3<P> position(std::uint32_t i) const { return {P(rule_.at.x[i]), P(rule_.at.y[i]), P(rule_.at.z[i])}; }
  // Relative to the middle of the block, in the image nearest to the middle.
  HOOKE_HD Vec3<P> from_middle(const Vec3<P>& x) const {
    return {displacement(x.x, middle_.x, 0), displacement(x.y, middle_.y, 1), displacement(x.z, middle_.z, 2)};
  }
  HOOKE_HD P displacement(const P& x_i, const P& x_p, int axis) const {
    const P d = x_i - x_p;
    if (!kPeriodic || !rule_.periodic[axis]) return d;
    const P length(component(rule_.length, axis));
    const P half = P(Real(0.5)) * length;
    return select(d > half, d - length, select(d < -half, d + length, d));
  }

  // Finds the points p near each point i to i + kPoints - 1, itself included, and puts them into its lane. With
  // |x_p - x_i|^2 multiplied out, the test is x_p^2 - 2 x_p x_i < reach^2 - x_i^2. A reach with p's radius in it is
  // multiplied out likewise.
  template <std::size_t kPoints>
  HOOKE_HD void list_near(std::uint32_t i, std::size_t count, Slice* slices) const {
    Vec3<P> twice[kPoints];
    P twice_reach[kPoints], limit[kPoints];
    for (std::size_t k = 0; k < kPoints; ++k) {
      const Vec3<P> own = from_middle(position(i + static_cast<std::uint32_t>(k)));
      P reach(rule_.reach);
      if constexpr (!kOneRadius) reach = reach + P(rule_.radius[i + k]);
      limit[k] = reach * reach - dot(own, own);
      twice[k] = P(Real(-2)) * own;
      twice_reach[k] = P(Real(-2)) * reach;
    }
    std::size_t near[kPoints] = {};
    Int32Vector numbers = ascending();
    for (std::size_t c = 0; c < count; c += P::kLanes, numbers += static_cast<std::int32_t>(P::kLanes)) {
      const Vec3<P> x{load(x_ + c), load(y_ + c), load(z_ + c)};
      const P square = load(square_ + c);
      for (std::size_t k = 0; k < kPoints; ++k) {
        P excess = square + twice[k].x * x.x + twice[k].y * x.y + twice[k].z * x.z;
        if constexpr (!kOneRadius) excess = excess + twice_reach[k] * load(radius_ + c);
        near[k] += append_where_less(near_ + k * near_room_ + near[k], numbers, excess, limit[k]);
      }
    }
    for (std::size_t k = 0; k < kPoints; ++k) {
      put_into_lane(i + static_cast<std::uint32_t>(k), near_ + k * near_room_, near[k], slices);
    }
  }

  // Copies the keys of the candidates `near` into point i's lane; its own key only with list_self.
  HOOKE_HD void put_into_lane(std::uint32_t i, const std::int32_t* near, std::size_t count, Slice* slices) const {
    const std::uint32_t slot = slot_of(i);
    rule_.neighbour_count[slot] = static_cast<std::uint8_t>(count < 255 ? count : 255);
    if (count == 0) return;
    Slice& slice = slices[slot % kWindow / kSliceLanes];
    clear_rows(slice, count);
    std::uint64_t* const lane = slice.rows + slot % kSliceLanes;
    std::uint64_t* own = lane;
    const std::uint64_t own_key = row_key(rule_.id_index[i], slot);
    for (std::size_t row = 0; row < count; ++row) {
      const std::uint64_t key = keys_[near[row]];
      lane[row * kSliceLanes] = key;
      own = key == own_key ? lane + row * kSliceLanes : own;
    }
    if (!rule_.list_self) {
      --count;
      *own = lane[count * kSliceLanes];
      lane[count * kSliceLanes] = last_key_;
    }
    if (count > slice.count) slice.count = count;
  }

  HOOKE_HD void clear_rows(Slice& slice, std::size_t count) const {
    for (; slice.cleared < count; ++slice.cleared) {
      for (std::size_t lane = 0; lane < kSliceLanes; ++lane) slice.rows[slice.cleared * kSliceLanes + lane] = last_key_;
    }
  }

  HOOKE_HD void write_rows(const Slice& slice) const {
    std::uint32_t* const entries = window_.room_for_rows(window_.list, slice.count);
    sort_rows(slice.rows, slice.count);
    if constexpr (kPackBytes > 16) {
      for (std::size_t k = 0; k < slice.count * kSliceLanes; k += Pack<double>::kLanes) {
        store(entries + k, lower_half(load_bits(slice.rows + k)) * rule_.stride);
      }
    } else {
      for (std::size_t k = 0; k < slice.count * kSliceLanes; ++k) {
        entries[k] = static_cast<std::uint32_t>(slice.rows[k]) * rule_.stride;
      }
    }
  }

  static constexpr std::uint32_t kInWindow = kWindow - 1;  // bits of a slot within its window

  // Copies: the compiler need not read them again after every store.
  const NeighbourRule<Real> rule_;
  const WindowSearch<Real> window_;
  Real* const x_ = window_.x;
  Real* const y_ = window_.y;
  Real* const z_ = window_.z;
  Real* const square_ = window_.square;
  Real* const radius_ = window_.radius;
  std::uint64_t* const keys_ = window_.keys;
  std::int32_t* const near_ = window_.near;
  const std::size_t near_room_ = window_.near_room;
  const std::uint64_t last_key_ = row_key(0x3fffffffU, rule_.filler);
  const WordVector ascending_words_ = ascending_words();
  Vec3<P> middle_;  // the block's
};

template <class Real, bool kOneRadius>
void choose_periodic(const NeighbourRule<Real>& rule, const WindowSearch<Real>& window) {
  if (rule.periodic[0] || rule.periodic[1] || rule.periodic[2]) {
    Search<Real, kOneRadius, true>(rule, window).run();
  } else {
    Search<Real, kOneRadius, false>(rule, window).run();
  }
}

template <class Real>
void choose_radius(const NeighbourRule<Real>& rule, const WindowSearch<Real>& window) {
  if (rule.radius == nullptr) {
    choose_periodic<Real, true>(rule, window);
  } else {
    choose_periodic<Real, false>(rule, window);
  }
}

}  // namespace

void search_window(const NeighbourRule<float>& rule, const WindowSearch<float>& window) { choose_radius(rule, window); }
void search_window(const NeighbourRule<double>& rule, const WindowSearch<double>& window) {
  choose_radius(rule, window);
}

}  // namespace hooke::HOOKE_ISA
