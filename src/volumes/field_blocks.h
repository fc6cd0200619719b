// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "hooke/base/vec3.h"

namespace hooke::volumes {

/// Sums over particles on a lattice of voxels, block by block. To every voxel within its reach, a particle adds the
/// weight w = (1 - d^2 / reach^2)^3, d (m) its distance from the voxel's centre, and w times each of its values. Voxel
/// (i, j, k) has its centre at (i, j, k) * edge of a voxel. Blocks are 8 x 8 x 8 voxels, k fastest: OpenVDB's leaves.
/// Threads work on all blocks at once; the sums do not depend on the number of threads.
class FieldBlocks {
 public:
  static constexpr int kEdge = 8;
  static constexpr std::size_t kVoxels = 512;
  static constexpr std::int32_t kMaxBlock = (1 << 20) - 64;  ///< largest coordinate of a block that holds a particle

  using Coordinates = std::array<std::int32_t, 3>;
  template <std::size_t kValues>
  struct Sums {
    std::array<float, kVoxels> weight;
    std::array<std::array<float, kVoxels>, kValues> value;
  };

  /// The coordinates, in blocks, of the block at `x`; empty where they exceed kMaxBlock.
  static std::optional<Coordinates> block_at(const Vec3d& x, double voxel) {
    Coordinates at{};
    for (int axis = 0; axis < 3; ++axis) {
      const double b = std::floor(component(x, axis) / (kEdge * voxel));
      if (!(std::abs(b) <= kMaxBlock)) return std::nullopt;
      at[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(b);
    }
    return at;
  }

  /// All positions must be within kMaxBlock, and reach (m, > 0) at most 32 blocks.
  FieldBlocks(std::span<const Vec3d> position, std::span<const double> reach, double voxel);

  /// Number of blocks that a particle may reach, sorted by their keys.
  std::size_t size() const { return blocks_.size(); }
  Coordinates coordinates(std::size_t block) const { return coordinates_of(blocks_[block]); }
  /// Index of the block at these coordinates; empty if there is none.
  std::optional<std::size_t> find(const Coordinates& at) const;

  /// Calls use(block, sums) for each of `chosen` (indices below size(), ascending), on all threads. `values` has one
  /// entry per particle.
  template <std::size_t kValues>
  void sum(std::span<const std::size_t> chosen, std::span<const std::array<float, kValues>> values,
           const std::function<void(std::size_t, const Sums<kValues>&)>& use) const;

 private:
  // 21 bits per axis, z fastest: a row of blocks along z is one range of keys.
  static constexpr std::int32_t kOffset = 1 << 20;
  static std::uint64_t key_of(const Coordinates& at) {
    const auto bits = [](std::int32_t c) { return static_cast<std::uint64_t>(c + kOffset); };
    return bits(at[0]) << 42U | bits(at[1]) << 21U | bits(at[2]);
  }
  static Coordinates coordinates_of(std::uint64_t key) {
    const auto axis = [&](unsigned shift) {
      return static_cast<std::int32_t>(key >> shift & ((1U << 21U) - 1)) - kOffset;
    };
    return {axis(42), axis(21), axis(0)};
  }

  template <std::size_t kValues>
  void add(const Coordinates& at, std::size_t n, std::span<const std::array<float, kValues>> values,
           Sums<kValues>& sums) const;

  std::span<const Vec3d> position_;
  std::span<const double> reach_;
  double voxel_;
  std::int32_t halo_ = 1;  // blocks: the distance at which a particle may still reach into a block
  std::vector<std::uint64_t> keys_;  // of the blocks that hold particles, ascending
  std::vector<std::uint32_t> order_;  // particle of each key
  std::vector<std::uint64_t> blocks_;  // keys, ascending
};

}  // namespace hooke::volumes
