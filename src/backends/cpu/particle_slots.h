// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/neighbours/layout.h"

namespace hooke {

/// Where in memory particles lie. First the listed particles, which touch others, in the order of the neighbour list,
/// with room after them for births. Then, from a whole tile on, the loose particles, which touch none: they are in no
/// list and never sorted, and a newborn takes the slot of a particle that is gone. Vacant slots hold vacant records.
class ParticleSlots {
 public:
  static constexpr std::size_t kLanes = kSliceLanes, kTile = hooke::kTile;

  /// Lays out so many particles of both kinds, with room for more. With `fixed`, the slot of a loose particle that is
  /// gone is free only after recycle().
  void lay_out(std::size_t listed, std::size_t more_listed, std::size_t loose, std::size_t more_loose, bool fixed) {
    listed_end_ = listed;
    loose_room_ = whole(loose + more_loose, kLanes);
    first_loose_ = whole(listed + more_listed, loose_room_ > 0 ? kTile : kLanes);
    loose_end_ = first_loose_ + loose;
    fixed_ = fixed;
    spare_.clear();
    left_.clear();
  }

  std::size_t listed_end() const { return listed_end_; }  ///< one past the last listed slot in use
  std::size_t first_loose() const { return first_loose_; }  ///< first loose slot, also one past the listed room
  std::size_t loose_end() const { return loose_end_; }  ///< one past the last loose slot ever used
  std::size_t room() const { return first_loose_ + loose_room_; }
  /// One past the last slot in use.
  std::size_t end() const { return loose_end_ > first_loose_ ? loose_end_ : listed_end_; }
  bool is_loose(std::size_t slot) const { return slot >= first_loose_; }

  bool has_room(std::size_t listed, std::size_t loose) const {
    return listed <= first_loose_ - std::min(first_loose_, whole(listed_end_, kWindow)) &&
           loose <= spare_.size() + (room() - loose_end_);
  }
  /// The slot of a newborn; there must be room. A listed slot is `from` or later.
  std::size_t take_listed(std::size_t from) {
    listed_end_ = std::max(listed_end_, from) + 1;
    HOOKE_ASSERT(listed_end_ <= first_loose_, listed_end_, first_loose_);
    return listed_end_ - 1;
  }
  std::size_t take_loose() {
    HOOKE_ASSERT(!spare_.empty() || loose_end_ < room(), loose_end_, room());
    if (spare_.empty()) return loose_end_++;
    const std::size_t slot = spare_.back();
    spare_.pop_back();
    return slot;
  }
  /// The particle in this slot is gone.
  void leave(std::size_t slot) {
    HOOKE_ASSERT(slot < end(), slot, end());
    if (is_loose(slot)) (fixed_ ? left_ : spare_).push_back(static_cast<std::uint32_t>(slot));
  }
  void recycle() {
    spare_.insert(spare_.end(), left_.begin(), left_.end());
    left_.clear();
  }
  /// The listed particles have been sorted; so many are left.
  void set_listed(std::size_t count) {
    HOOKE_ASSERT(count <= listed_end_, count, listed_end_);
    listed_end_ = count;
  }

  /// The number of tiles in use, of both kinds, and the index of the n-th one.
  std::size_t tile_count() const { return listed_tiles() + whole(loose_end_ - first_loose_, kTile) / kTile; }
  std::size_t tile(std::size_t n) const { return n < listed_tiles() ? n : first_loose_ / kTile + (n - listed_tiles()); }
  /// One past the last slot of a tile that is in use.
  std::size_t end_of(std::size_t tile) const {
    return std::min((tile + 1) * kTile, is_loose(tile * kTile) ? loose_end_ : listed_end_);
  }

 private:
  static constexpr std::size_t whole(std::size_t n, std::size_t of) { return (n + of - 1) / of * of; }
  std::size_t listed_tiles() const { return whole(listed_end_, kTile) / kTile; }

  std::size_t listed_end_ = 0, first_loose_ = 0, loose_end_ = 0, loose_room_ = 0;
  bool fixed_ = false;
  std::vector<std::uint32_t> spare_, left_;  // vacant loose slots: free, and free after recycle()
};

}  // namespace hooke
