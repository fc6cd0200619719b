// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/base/vec3.h"

namespace hooke {

/// An axis-parallel box, its faces included.
template <class R>
struct Box3 {
  Vec3<R> min{0, 0, 0}, max{0, 0, 0};

  /// The one that contains nothing, which add() starts from: inside out.
  static HOOKE_HD Box3 none() {
    constexpr R kInfinite = static_cast<R>(__builtin_inff());
    return {{kInfinite, kInfinite, kInfinite}, {-kInfinite, -kInfinite, -kInfinite}};
  }
  HOOKE_HD bool is_none() const { return min.x > max.x; }

  /// Grows until it contains a point, or another box. A NaN is left out.
  HOOKE_HD void add(const Vec3<R>& x) { add(Box3{x, x}); }
  HOOKE_HD void add(const Box3& box) {
    for (int axis = 0; axis < 3; ++axis) {
      R &low = component(min, axis), &high = component(max, axis);
      low = component(box.min, axis) < low ? component(box.min, axis) : low;
      high = component(box.max, axis) > high ? component(box.max, axis) : high;
    }
  }

  HOOKE_HD bool contains(const Vec3<R>& x) const {
    return x.x >= min.x && x.y >= min.y && x.z >= min.z && x.x <= max.x && x.y <= max.y && x.z <= max.z;
  }
  HOOKE_HD Vec3<R> center() const { return R(0.5) * (min + max); }
  HOOKE_HD Vec3<R> extent() const { return max - min; }

  friend bool operator==(const Box3&, const Box3&) = default;
};

using Box3d = Box3<double>;

}  // namespace hooke
