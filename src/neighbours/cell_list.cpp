// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/neighbours/cell_list.h"

#include <algorithm>
#include <array>
#include <utility>

#include "hooke/base/assert.h"

namespace hooke {

void CellList::lay_out(const Vec3d& min, const Vec3d& max, const bool (&periodic)[3], std::span<const Level> levels,
                       std::size_t most_points) {
  levels_.clear();
  key_end_ = 0;
  for (const Level& level : levels) {
    HOOKE_ASSERT(level.cell > 0 && level.largest_radius >= 0, level.cell, level.largest_radius);
    levels_.push_back({CellGrid{}, level.largest_radius, key_end_});
    Vec3d reach{level.cell, level.cell, level.cell};
    component(reach, CellGrid::path_axes(min, max)[0]) /= kCellsAlongRow;
    levels_.back().grid.lay_out(min, max, periodic, reach);
    key_end_ += levels_.back().grid.key_end();
  }
  // 4 entries per point take as much memory as 2 and the point's key, which is kept if entries stand for several cells.
  const std::uint64_t most_slots = std::max<std::uint64_t>(4096, 4 * most_points);
  slot_bits_ = 0;
  while (key_end_ >> slot_bits_ > most_slots) ++slot_bits_;
}

CellList::Room CellList::make_room(std::size_t count, std::span<std::byte> scratch) {
  HOOKE_ASSERT(count <= std::uint64_t{1} << 32U, count);
  const std::size_t needed = count * (sizeof(std::uint64_t) + sizeof(KeyedPoint));
  if (scratch.size() < needed || reinterpret_cast<std::uintptr_t>(scratch.data()) % alignof(KeyedPoint) != 0) {
    own_room_.resize(needed / sizeof(std::uint64_t));
    scratch = std::as_writable_bytes(std::span(own_room_));
  }
  auto* keys = reinterpret_cast<std::uint64_t*>(scratch.data());
  return {{keys, count}, {reinterpret_cast<KeyedPoint*>(keys + count), count}};
}

// Distributes the points to parts, each a range of keys, then sorts each part by counting.
void CellList::sort_keys(const Room& room, std::vector<std::uint32_t>& order) {
  constexpr std::size_t kMostParts = 1024;
  constexpr std::size_t kBlock = std::size_t{1} << 14U;  // points
  const std::size_t count = room.keys.size();
  const std::size_t slots = (key_end_ >> slot_bits_) + 1;
  unsigned part_bits = 0;  // a part has 2^part_bits slots
  while ((slots - 1) >> part_bits >= kMostParts) ++part_bits;
  const std::size_t parts = ((slots - 1) >> part_bits) + 1;
  const std::size_t part_slots = std::size_t{1} << part_bits;
  const unsigned part_shift = slot_bits_ + part_bits;

  using Counts = std::array<std::uint32_t, kMostParts>;
  std::vector<Counts> starts((count + kBlock - 1) / kBlock);
  parallel_ranges(starts.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t block = first; block < last; ++block) {
      starts[block].fill(0);
      const std::size_t end = std::min((block + 1) * kBlock, count);
      for (std::size_t i = block * kBlock; i < end; ++i) {
        HOOKE_ASSERT(room.keys[i] <= key_end_, i, room.keys[i], key_end_);
        ++starts[block][room.keys[i] >> part_shift];
      }
    }
  });
  std::vector<std::uint32_t> part_start(parts + 1, 0);
  std::uint32_t start = 0;
  for (std::size_t part = 0; part < parts; ++part) {
    part_start[part] = start;
    for (Counts& counts : starts) start += std::exchange(counts[part], start);
  }
  part_start[parts] = start;
  parallel_ranges(starts.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t block = first; block < last; ++block) {
      const std::size_t end = std::min((block + 1) * kBlock, count);
      for (std::size_t i = block * kBlock; i < end; ++i) {
        const std::uint64_t key = room.keys[i];
        room.points[starts[block][key >> part_shift]++] = {key, static_cast<std::uint32_t>(i)};
      }
    }
  });

  order.resize(count);
  keys_.resize(slot_bits_ == 0 ? 0 : count);
  starts_.resize(slots + 1);
  starts_[slots] = static_cast<std::uint32_t>(count);
  parallel_ranges(parts, 1, [&](std::size_t first, std::size_t last) {
    std::vector<KeyedPoint> sorted;
    for (std::size_t part = first; part < last; ++part) {
      const std::uint32_t part_first = part_start[part];
      const std::span points = room.points.subspan(part_first, part_start[part + 1] - part_first);
      const std::size_t first_slot = part << part_bits;
      const std::span slot_starts = std::span(starts_).subspan(first_slot, std::min(slots - first_slot, part_slots));
      sort_part(points, first_slot, part_first, slot_starts, sorted);
      for (std::size_t k = 0; k < points.size(); ++k) order[part_first + k] = sorted[k].index;
      if (slot_bits_ == 0) continue;
      for (std::size_t k = 0; k < points.size(); ++k) keys_[part_first + k] = sorted[k].key;
    }
  });
}

// Sorts the points of some slots; `starts` receives the first point of each slot.
void CellList::sort_part(std::span<const KeyedPoint> points, std::size_t first_slot, std::uint32_t first_point,
                         std::span<std::uint32_t> starts, std::vector<KeyedPoint>& sorted) const {
  const auto slot_of = [&](const KeyedPoint& p) { return (p.key >> slot_bits_) - first_slot; };
  sorted.resize(std::max(sorted.size(), points.size()));
  std::fill(starts.begin(), starts.end(), 0);
  for (const KeyedPoint& p : points) ++starts[slot_of(p)];
  std::uint32_t next = 0;
  for (std::uint32_t& start : starts) next += std::exchange(start, next);
  for (const KeyedPoint& p : points) sorted[starts[slot_of(p)]++] = p;  // moves each start to its slot's end
  std::uint32_t first = 0;
  for (std::uint32_t& start : starts) {
    const std::uint32_t end = std::exchange(start, first_point + first);
    if (slot_bits_ > 0 && end - first > 1) {
      std::sort(sorted.begin() + first, sorted.begin() + end, [](const KeyedPoint& a, const KeyedPoint& b) {
        return a.key != b.key ? a.key < b.key : a.index < b.index;
      });
    }
    first = end;
  }
}

std::uint32_t CellList::first_in_slot(std::uint64_t slot, std::uint64_t key) const {
  const auto begin = keys_.begin() + starts_[slot], end = keys_.begin() + starts_[slot + 1];
  constexpr std::ptrdiff_t kFew = 16;
  // Counted, not searched, where keys are few: a wrong guess costs more than a dozen comparisons.
  if (end - begin <= kFew) {
    std::uint32_t less = 0;
    for (auto k = begin; k < end; ++k) less += *k < key ? 1 : 0;
    return starts_[slot] + less;
  }
  return static_cast<std::uint32_t>(std::lower_bound(begin, end, key) - keys_.begin());
}

std::size_t CellList::find(std::size_t level, const Vec3d& min, const Vec3d& max, std::vector<SearchRange>& out) const {
  HOOKE_ASSERT(level < level_count(), level, level_count());
  std::size_t points = 0;
  for_ranges(level, min, max, [&](const SearchRange& range) {
    out.push_back(range);
    points += range.to - range.from;
  });
  return points;
}

}  // namespace hooke
