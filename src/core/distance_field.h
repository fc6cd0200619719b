// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hooke/base/vec3.h"
#include "hooke/physics/distance_field.h"

namespace hooke {

/// Owns the distance from the surface of a mesh, sampled around it (physics/distance_field.h).
struct DistanceField {
  Vec3d origin{0, 0, 0};               ///< lower corner of the first brick, m
  double cell = 1;                     ///< m
  std::array<std::int32_t, 3> bricks{0, 0, 0};
  std::vector<std::uint64_t> keys;     ///< of the bricks that have samples, ascending
  std::vector<BrickSlot> slots;        ///< made of the keys by make_directory()
  unsigned hash_shift = 63;
  std::vector<float> samples;          ///< 729 per key
  bool open = false;                   ///< the mesh encloses nothing: distances are never negative
  Vec3d min{0, 0, 0}, max{0, 0, 0};    ///< box around the surface, m
  double band = 0;                     ///< there are samples at least this far from the surface on either side, m

  /// Makes the directory that view() needs, from `keys`.
  void make_directory();

  /// Bytes of samples and directory.
  std::size_t bytes() const;

  DistanceFieldView view() const {
    return {cell,        {bricks[0], bricks[1], bricks[2]},      slots.data(),  hash_shift,
            keys.data(), static_cast<std::int32_t>(keys.size()), samples.data()};
  }
};

}  // namespace hooke
