// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hooke/base/box3.h"
#include "hooke/base/vec3.h"

namespace hooke::scene {

/// The upward direction: against gravity's largest component; +y without gravity.
struct UpDirection {
  int axis = 1;  ///< 0, 1, 2 for x, y, z
  bool positive = true;
};
UpDirection up_against(const Vec3d& gravity);

enum class LatticeKind { cubic, hcp };

/// The sites of a lattice in a box, layer by layer from the lowest. Within a layer the lattice starts at the box's
/// lower faces; the layers start at the box's lowest face, seen along `up`.
class Lattice {
 public:
  /// `spacing`: distance of nearest neighbours, m, > 0.
  Lattice(LatticeKind kind, const Box3d& box, double spacing, UpDirection up);

  /// Number of sites; saturates at 2^63.
  std::uint64_t site_count() const;

  /// Appends the first `count` sites, or all if there are fewer.
  void append_sites(std::uint64_t count, std::vector<Vec3d>& out) const { append_sites(0, count, out); }
  /// The same from site `first` on.
  void append_sites(std::uint64_t first, std::uint64_t count, std::vector<Vec3d>& out) const;

 private:
  // Sites of one layer: rows along `row_axis_`, side by side along the third axis.
  struct Layer {
    double row_offset;     // of the first row, along the third axis, m
    std::uint64_t rows;
    double site_offset[2];  // of the first site in even and odd rows, m
    std::uint64_t sites[2];
  };
  Layer layer(bool odd) const;
  std::uint64_t sites_in(const Layer& layer) const;

  LatticeKind kind_;
  Box3d box_;
  double spacing_;
  UpDirection up_;
  int row_axis_;
  int third_axis_;
  double row_distance_;
  double layer_distance_;
  std::uint64_t layers_;
};

}  // namespace hooke::scene
