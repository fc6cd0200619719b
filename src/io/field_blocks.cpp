// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/io/field_blocks.h"

namespace hooke {

FieldBlocks::FieldBlocks(std::span<const Vec3d> position, std::span<const double> reach, double voxel)
    : position_(position),
      reach_(reach),
      voxel_(voxel) {
  double longest = 0;
  for (const double r : reach) longest = std::max(longest, r);
  halo_ = static_cast<std::int32_t>(std::ceil(longest / (kEdge * voxel)));

  keys_.resize(position.size());
  for (std::size_t i = 0; i < position.size(); ++i) keys_[i] = key_of(*block_at(position[i], voxel));
  sort_by_key(keys_, order_);

  for (std::size_t i = 0; i < keys_.size(); ++i) {
    if (i > 0 && keys_[i] == keys_[i - 1]) continue;
    const Coordinates at = coordinates_of(keys_[i]);
    for (std::int32_t x = -halo_; x <= halo_; ++x) {
      for (std::int32_t y = -halo_; y <= halo_; ++y) {
        for (std::int32_t z = -halo_; z <= halo_; ++z) blocks_.push_back(key_of({at[0] + x, at[1] + y, at[2] + z}));
      }
    }
  }
  std::vector<std::uint32_t> unused;
  sort_by_key(blocks_, unused);
  blocks_.erase(std::unique(blocks_.begin(), blocks_.end()), blocks_.end());
}

std::optional<std::size_t> FieldBlocks::find(const Coordinates& at) const {
  const auto found = std::lower_bound(blocks_.begin(), blocks_.end(), key_of(at));
  if (found == blocks_.end() || *found != key_of(at)) return std::nullopt;
  return static_cast<std::size_t>(found - blocks_.begin());
}

}  // namespace hooke
