// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "hooke/core/scene.h"
#include "hooke/core/shapes.h"

namespace hooke {

/// The sinks of a scene, each with a box around it that rules out most particles quickly.
class PlacedSinks {
 public:
  PlacedSinks() = default;
  explicit PlacedSinks(const std::vector<Sink>& sinks);

  /// Whether a sink takes a particle with its centre at x (m).
  bool take(const Vec3d& x) const {
    return std::any_of(sinks_.begin(), sinks_.end(),
                       [&](const Placed& sink) { return sink.box.contains(x) && encloses(sink, x); });
  }

 private:
  struct Placed {
    Box3d box;
    ShapeGeometry<double> shape;
  };
  static bool encloses(const Placed& sink, const Vec3d& x);

  std::vector<Placed> sinks_;
};

}  // namespace hooke
