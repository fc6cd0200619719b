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
/// with room after them for births. Then, from a whole tile on, the noninteracting particles, which touch none: they
/// are in no list and never sorted, and a newborn takes the slot of a particle that is gone. Behind them all lie
/// ghosts, copies of other ranks' particles, which are in the list as neighbours only. Vacant slots hold vacant
/// records.
class ParticleSlots {
 public:
  static constexpr std::size_t kLanes = kSliceLanes, kTile = hooke::kTile;

  /// Lays out so many particles of both kinds, with room for more. With `fixed`, the slot of a noninteracting particle
  /// that is gone is free only after recycle().
  void lay_out(std::size_t listed, std::size_t more_listed, std::size_t noninteracting, std::size_t more_noninteracting,
               bool fixed) {
    interacting_end_ = listed;
    noninteracting_room_ = whole(noninteracting + more_noninteracting, kLanes);
    first_noninteracting_ = whole(listed + more_listed, noninteracting_room_ > 0 ? kTile : kLanes);
    noninteracting_end_ = first_noninteracting_ + noninteracting;
    fixed_ = fixed;
    spare_.clear();
    left_.clear();
    lay_out_ghosts(0);
  }
  /// Lays out so many ghosts; end() and room() leave them out.
  void lay_out_ghosts(std::size_t ghosts) {
    first_ghost_ = whole(room(), kWindow);
    ghost_end_ = first_ghost_ + ghosts;
  }

  std::size_t interacting_end() const { return interacting_end_; }  ///< one past the last listed slot in use
  std::size_t first_noninteracting() const {
    return first_noninteracting_;
  }  ///< first noninteracting slot, also one past the listed room
  std::size_t noninteracting_end() const {
    return noninteracting_end_;
  }  ///< one past the last noninteracting slot ever used
  std::size_t room() const { return first_noninteracting_ + noninteracting_room_; }
  /// One past the last slot in use.
  std::size_t end() const {
    return noninteracting_end_ > first_noninteracting_ ? noninteracting_end_ : interacting_end_;
  }
  bool has_ghosts() const { return ghost_end_ > first_ghost_; }
  std::size_t first_ghost() const { return first_ghost_; }
  std::size_t ghost_end() const { return ghost_end_; }
  bool is_noninteracting(std::size_t slot) const { return slot >= first_noninteracting_; }

  bool has_room(std::size_t listed, std::size_t noninteracting) const {
    return listed <= first_noninteracting_ - std::min(first_noninteracting_, whole(interacting_end_, kWindow)) &&
           noninteracting <= spare_.size() + (room() - noninteracting_end_);
  }
  /// The slot of a newborn; there must be room. A listed slot is `from` or later.
  std::size_t take_interacting(std::size_t from) {
    interacting_end_ = std::max(interacting_end_, from) + 1;
    HOOKE_ASSERT(interacting_end_ <= first_noninteracting_, interacting_end_, first_noninteracting_);
    return interacting_end_ - 1;
  }
  std::size_t take_noninteracting() {
    HOOKE_ASSERT(!spare_.empty() || noninteracting_end_ < room(), noninteracting_end_, room());
    if (spare_.empty()) return noninteracting_end_++;
    const std::size_t slot = spare_.back();
    spare_.pop_back();
    return slot;
  }
  /// The particle in this slot is gone.
  void leave(std::size_t slot) {
    HOOKE_ASSERT(slot < end(), slot, end());
    if (is_noninteracting(slot)) (fixed_ ? left_ : spare_).push_back(static_cast<std::uint32_t>(slot));
  }
  void recycle() {
    spare_.insert(spare_.end(), left_.begin(), left_.end());
    left_.clear();
  }
  /// The listed particles have been sorted; so many are left.
  void set_interacting(std::size_t count) {
    HOOKE_ASSERT(count <= interacting_end_, count, interacting_end_);
    interacting_end_ = count;
  }

  /// The number of tiles in use, of both kinds, and the index of the n-th one.
  std::size_t tile_count() const {
    return listed_tiles() + whole(noninteracting_end_ - first_noninteracting_, kTile) / kTile;
  }
  std::size_t tile(std::size_t n) const {
    return n < listed_tiles() ? n : first_noninteracting_ / kTile + (n - listed_tiles());
  }
  /// One past the last slot of a tile that is in use.
  std::size_t end_of(std::size_t tile) const {
    return std::min((tile + 1) * kTile, is_noninteracting(tile * kTile) ? noninteracting_end_ : interacting_end_);
  }

 private:
  static constexpr std::size_t whole(std::size_t n, std::size_t of) { return (n + of - 1) / of * of; }
  std::size_t listed_tiles() const { return whole(interacting_end_, kTile) / kTile; }

  std::size_t interacting_end_ = 0, first_noninteracting_ = 0, noninteracting_end_ = 0, noninteracting_room_ = 0;
  std::size_t first_ghost_ = 0, ghost_end_ = 0;
  bool fixed_ = false;
  std::vector<std::uint32_t> spare_, left_;  // vacant noninteracting slots: free, and free after recycle()
};

}  // namespace hooke
