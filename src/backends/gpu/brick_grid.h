// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "hooke/base/hash.h"
#include "hooke/base/vec3.h"

namespace hooke::gpu {

/// A uniform grid whose cells are numbered brick by brick, so that the particles that a block of threads looks at lie
/// close together. Bricks have places of their own in the table of cells where there are not too many; else they share
/// places by a hash, so that the table goes with the particles and not with the domain.
struct BrickGrid {
  static constexpr std::uint32_t kX = 8, kY = 4, kZ = 4, kCells = kX * kY * kZ;  ///< a brick's edges, and its cells
  static constexpr std::uint32_t kMostAlong = 1U << 20U;                         ///< cells along an axis

  struct Axis {
    double origin = 0, inverse = 1;  // m, 1/m
    std::uint32_t cells = 1, bricks = 1;
    bool periodic = false;
  };
  /// The cells at and beside one along an axis, each once.
  struct Beside {
    std::uint32_t of[3];
    int count;
  };

  Axis axes[3];
  double cell = 1;             // m, the smallest edge of a cell
  std::uint32_t places = 1;    // of bricks in the table
  bool hashed = false;         // then a power of two of them

  /// Over the domain, with cells no smaller than `reach` (m), and at most about two per particle.
  static BrickGrid over(const Vec3d& min, const Vec3d& max, const bool (&periodic)[3], double reach,
                        std::uint64_t particles) {
    constexpr std::uint32_t kEdge[3] = {kX, kY, kZ};
    BrickGrid grid;
    double bricks = 1;
    grid.cell = std::numeric_limits<double>::max();
    for (int a = 0; a < 3; ++a) {
      Axis& axis = grid.axes[a];
      const double length = component(max, a) - component(min, a);
      const double fit = std::floor(length / (reach * (1 + 1e-6)));
      axis.periodic = periodic[a];
      axis.origin = component(min, a);
      axis.cells = static_cast<std::uint32_t>(std::clamp(fit, 1.0, double{kMostAlong}));
      // Around a periodic axis bricks are whole, so that bricks that are not adjacent are a brick's edge apart.
      if (axis.periodic && axis.cells > kEdge[a]) axis.cells = axis.cells / kEdge[a] * kEdge[a];
      axis.inverse = axis.cells / length;
      axis.bricks = (axis.cells + kEdge[a] - 1) / kEdge[a];
      bricks *= axis.bricks;
      grid.cell = std::min(grid.cell, length / axis.cells);
    }
    const double most = 2.0 * static_cast<double>(particles) / kCells + 64;
    grid.hashed = bricks > most;
    if (!grid.hashed) {
      grid.places = static_cast<std::uint32_t>(bricks);
    } else {
      while (2.0 * grid.places <= most) grid.places *= 2;
    }
    return grid;
  }

  /// Cells of the table.
  HOOKE_HD std::uint32_t key_end() const { return places * kCells; }

  /// The index along an axis of the cell of a finite coordinate; outside of the domain, that of the nearest cell.
  HOOKE_HD std::uint32_t index(double x, int axis) const {
    const double at = (x - axes[axis].origin) * axes[axis].inverse, last = axes[axis].cells - 1;
    const double inside = at > 0 ? at : 0;
    return static_cast<std::uint32_t>(inside < last ? inside : last);
  }
  /// The number of a cell in the table.
  HOOKE_HD std::uint32_t key(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return place(x / kX, y / kY, z / kZ) * kCells + ((z % kZ) * kY + y % kY) * kX + x % kX;
  }
  HOOKE_HD Beside beside(std::uint32_t at, int axis) const {
    const std::uint32_t n = axes[axis].cells;
    Beside found{{0, 0, 0}, 0};
    if (axes[axis].periodic) {
      if (n <= 3) {
        for (std::uint32_t k = 0; k < n; ++k) found.of[found.count++] = k;
        return found;
      }
      return {{at > 0 ? at - 1 : n - 1, at, at + 1 < n ? at + 1 : 0}, 3};
    }
    for (std::uint32_t k = at > 0 ? at - 1 : 0; k <= at + 1 && k < n; ++k) found.of[found.count++] = k;
    return found;
  }

 private:
  HOOKE_HD std::uint32_t place(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    if (!hashed) return (z * axes[1].bricks + y) * axes[0].bricks + x;
    const std::uint64_t number = (static_cast<std::uint64_t>(z) * axes[1].bricks + y) * axes[0].bricks + x;
    return static_cast<std::uint32_t>((number * 0x9e3779b97f4a7c15U) >> 32U) & (places - 1);  // Knuth's hashing
  }
};

}  // namespace hooke::gpu
