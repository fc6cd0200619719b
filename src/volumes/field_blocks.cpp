// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/volumes/field_blocks.h"

#include <algorithm>

#include "hooke/base/parallel.h"
#include "hooke/neighbours/cell_grid.h"

namespace hooke::volumes {

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

template <std::size_t kValues>
void FieldBlocks::add(const Coordinates& at, std::size_t n, std::span<const std::array<float, kValues>> values,
                      Sums<kValues>& sums) const {
  const std::size_t particle = order_[n];
  const double reach = reach_[particle] / voxel_;
  // In voxels from the block's first voxel.
  const auto from_corner = [&](int axis) {
    return component(position_[particle], axis) / voxel_ - double{kEdge} * at[static_cast<std::size_t>(axis)];
  };
  const double x = from_corner(0), y = from_corner(1), z = from_corner(2);
  if (z + reach < 0 || z - reach > kEdge - 1) return;
  const auto first = [&](double c) { return std::max(0, static_cast<int>(std::ceil(c - reach))); };
  const auto last = [&](double c) { return std::min(kEdge - 1, static_cast<int>(std::floor(c + reach))); };

  const auto scale = static_cast<float>(1 / (reach * reach));
  std::array<float, kEdge> depth;  // (dz / reach)^2
  for (int k = 0; k < kEdge; ++k) {
    const auto dz = static_cast<float>(k - z);
    depth[static_cast<std::size_t>(k)] = scale * dz * dz;
  }
  for (int i = first(x); i <= last(x); ++i) {
    for (int j = first(y); j <= last(y); ++j) {
      const double dx = i - x;
      const double dy = j - y;
      const float rest = 1 - scale * static_cast<float>(dx * dx + dy * dy);
      if (rest <= 0) continue;
      const auto row = static_cast<std::size_t>((i * kEdge + j) * kEdge);
      for (std::size_t k = 0; k < kEdge; ++k) {
        const float t = rest > depth[k] ? rest - depth[k] : 0.0F;
        const float w = t * t * t;
        sums.weight[row + k] += w;
        for (std::size_t v = 0; v < kValues; ++v) sums.value[v][row + k] += w * values[particle][v];
      }
    }
  }
}

template <std::size_t kValues>
void FieldBlocks::sum(std::span<const std::size_t> chosen, std::span<const std::array<float, kValues>> values,
                      const std::function<void(std::size_t, const Sums<kValues>&)>& use) const {
  parallel_ranges(chosen.size(), 16, [&](std::size_t first, std::size_t last) {
    Sums<kValues> sums;
    std::vector<KeyCursor> cursors(static_cast<std::size_t>((2 * halo_ + 1) * (2 * halo_ + 1)));
    for (std::size_t c = first; c < last; ++c) {
      sums.weight.fill(0);
      for (auto& value : sums.value) value.fill(0);
      const Coordinates at = coordinates(chosen[c]);
      auto cursor = cursors.begin();
      for (std::int32_t x = at[0] - halo_; x <= at[0] + halo_; ++x) {
        for (std::int32_t y = at[1] - halo_; y <= at[1] + halo_; ++y, ++cursor) {
          const std::uint64_t row_end = key_of({x, y, at[2] + halo_});
          for (std::size_t n = cursor->seek(keys_, key_of({x, y, at[2] - halo_}));
               n < keys_.size() && keys_[n] <= row_end; ++n) {
            add<kValues>(at, n, values, sums);
          }
        }
      }
      use(chosen[c], sums);
    }
  });
}

template void FieldBlocks::sum(std::span<const std::size_t>, std::span<const std::array<float, 0>>,
                               const std::function<void(std::size_t, const Sums<0>&)>&) const;
template void FieldBlocks::sum(std::span<const std::size_t>, std::span<const std::array<float, 1>>,
                               const std::function<void(std::size_t, const Sums<1>&)>&) const;
template void FieldBlocks::sum(std::span<const std::size_t>, std::span<const std::array<float, 3>>,
                               const std::function<void(std::size_t, const Sums<3>&)>&) const;

}  // namespace hooke::volumes
