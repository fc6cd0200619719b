// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/random_packing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "hooke/base/assert.h"
#include "hooke/base/random.h"

namespace hooke::scene {
namespace {

// Makes these draws differ from the jitter's with the same seed.
constexpr std::uint32_t kPurpose = 1;

using Index3 = std::array<std::uint64_t, 3>;

// Ebeida et al., "A simple algorithm for maximal Poisson-disk sampling in high dimensions", 2012: darts are thrown at
// voxels that are not yet wholly covered; when few darts stick, voxels are split in eight and covered ones dropped.
class Packing {
 public:
  Packing(const Box3d& box, double spacing, std::uint64_t count, std::uint64_t seed)
      : box_(box),
        spacing_squared_(spacing * spacing),
        count_(count),
        seed_(seed) {
    // Cells are at least a spacing wide, so any nearer centre lies in one of the 27 cells around. There are at most
    // about two cells per centre, so that a few centres in a vast box need little memory.
    width_ = spacing;
    const double most_cells = 64 + 2 * std::min(static_cast<double>(count), random_packing_bound(box, spacing));
    while (cell_count(width_) > most_cells) width_ *= 2;
    std::size_t total = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cells_[axis] = cells_along(axis, width_);
      total *= cells_[axis];
    }
    first_in_cell_.assign(total, kNone);
    voxels_.reserve(total);
    for (std::uint64_t z = 0; z < cells_[2]; ++z) {
      for (std::uint64_t y = 0; y < cells_[1]; ++y) {
        for (std::uint64_t x = 0; x < cells_[0]; ++x) voxels_.push_back({x, y, z});
      }
    }
  }

  std::vector<Vec3d> run() {
    constexpr int kMostSplits = 6;  // less than 1e-5 of the box is free then
    for (int splits = 0; splits <= kMostSplits && !voxels_.empty(); ++splits) {
      while (throw_darts()) {}
      if (centres_.size() >= count_) break;
      split_voxels();
    }
    return std::move(centres_);
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  double length(std::size_t axis) const {
    return component(box_.max, static_cast<int>(axis)) - component(box_.min, static_cast<int>(axis));
  }
  std::uint64_t cells_along(std::size_t axis, double width) const {
    return static_cast<std::uint64_t>(length(axis) / width) + 1;
  }
  double cell_count(double width) const {
    double product = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) product *= std::floor(length(axis) / width) + 1;
    return product;
  }

  // One round: as many darts as there are voxels. Returns whether enough of them stuck to throw another round.
  bool throw_darts() {
    const std::uint64_t darts = std::max<std::uint64_t>(voxels_.size(), 256);
    const std::size_t before = centres_.size();
    for (std::uint64_t i = 0; i < darts && centres_.size() < count_; ++i) {
      const auto random = uniform4(seed_, next_dart_++, 0, kPurpose);
      const auto pick = static_cast<std::size_t>(random[0] * static_cast<double>(voxels_.size()));
      Vec3d dart{0, 0, 0};
      bool inside = true;
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const double offset = (static_cast<double>(voxels_[pick][a]) + random[a + 1]) * voxel_width_in_cells_ * width_;
        // A box that is flat along an axis has one plane of centres there.
        component(dart, axis) = component(box_.min, axis) + (length(a) > 0 ? offset : 0);
        inside = inside && component(dart, axis) <= component(box_.max, axis);
      }
      if (inside && is_free(dart)) keep(dart);
    }
    return centres_.size() < count_ && (centres_.size() - before) * 32 >= darts;
  }

  Index3 cell_of(const Vec3d& x) const {
    Index3 cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double offset = component(x, static_cast<int>(axis)) - component(box_.min, static_cast<int>(axis));
      cell[axis] = std::min(static_cast<std::uint64_t>(std::max(offset, 0.0) / width_), cells_[axis] - 1);
    }
    return cell;
  }
  std::size_t flat(const Index3& cell) const { return (cell[2] * cells_[1] + cell[1]) * cells_[0] + cell[0]; }

  // Whether `is_hit` holds for any centre in the 27 cells around `cell`.
  template <class IsHit>
  bool any_near(const Index3& cell, IsHit is_hit) const {
    Index3 low{};
    Index3 high{};
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = cell[a] == 0 ? 0 : cell[a] - 1;
      high[a] = std::min(cell[a] + 1, cells_[a] - 1);
    }
    for (std::uint64_t z = low[2]; z <= high[2]; ++z) {
      for (std::uint64_t y = low[1]; y <= high[1]; ++y) {
        for (std::uint64_t x = low[0]; x <= high[0]; ++x) {
          for (std::uint32_t i = first_in_cell_[flat({x, y, z})]; i != kNone; i = next_in_cell_[i]) {
            if (is_hit(centres_[i])) return true;
          }
        }
      }
    }
    return false;
  }

  bool is_free(const Vec3d& x) const {
    return !any_near(cell_of(x), [&](const Vec3d& centre) {
      const Vec3d d = x - centre;
      return dot(d, d) < spacing_squared_;
    });
  }

  void keep(const Vec3d& x) {
    const std::size_t cell = flat(cell_of(x));
    next_in_cell_.push_back(first_in_cell_[cell]);
    first_in_cell_[cell] = static_cast<std::uint32_t>(centres_.size());
    centres_.push_back(x);
  }

  // Whether a single centre covers all of a voxel: the voxel's farthest corner is within the spacing.
  bool is_covered(const Index3& voxel, double voxel_width) const {
    Vec3d low{0, 0, 0};
    Vec3d high{0, 0, 0};
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const bool flat_axis = !(length(a) > 0);
      component(low, axis) = component(box_.min, axis) + (flat_axis ? 0 : static_cast<double>(voxel[a]) * voxel_width);
      component(high, axis) = flat_axis ? component(low, axis) : component(low, axis) + voxel_width;
    }
    return any_near(cell_of(0.5 * (low + high)), [&](const Vec3d& centre) {
      const auto farthest = [](double a, double b) { return std::max(a * a, b * b); };
      return farthest(low.x - centre.x, high.x - centre.x) + farthest(low.y - centre.y, high.y - centre.y) +
                 farthest(low.z - centre.z, high.z - centre.z) <
             spacing_squared_;
    });
  }

  void split_voxels() {
    std::vector<Index3> children;
    const double child_width_in_cells = voxel_width_in_cells_ / 2;
    const double child_width = child_width_in_cells * width_;
    for (const Index3& voxel : voxels_) {
      for (std::uint64_t corner = 0; corner < 8; ++corner) {
        Index3 child{};
        bool inside = true;
        for (std::size_t a = 0; a < 3; ++a) {
          child[a] = 2 * voxel[a] + ((corner >> a) & 1U);
          inside = inside && (length(a) > 0 ? static_cast<double>(child[a]) * child_width <= length(a)
                                            : child[a] == 2 * voxel[a]);
        }
        if (inside && !is_covered(child, child_width)) children.push_back(child);
      }
    }
    voxels_ = std::move(children);
    voxel_width_in_cells_ = child_width_in_cells;
  }

  Box3d box_;
  double spacing_squared_;
  std::uint64_t count_;
  std::uint64_t seed_;
  double width_;  // of a cell, m
  Index3 cells_{1, 1, 1};
  std::vector<std::uint32_t> first_in_cell_;  // linked lists of the centres in each cell
  std::vector<std::uint32_t> next_in_cell_;
  std::vector<Vec3d> centres_;
  std::vector<Index3> voxels_;  // voxels not yet known to be covered, in units of their width
  double voxel_width_in_cells_ = 1;
  std::uint64_t next_dart_ = 0;
};

}  // namespace

double random_packing_bound(const Box3d& box, double spacing) {
  HOOKE_ASSERT(spacing > 0, spacing);
  // Spheres with a diameter of one spacing, in the box grown by half a spacing on all sides, fill at most 0.74 of it.
  constexpr double kDensestPacking = 1.4142135623730951;  // centres a cubed spacing
  double bound = kDensestPacking;
  for (int axis = 0; axis < 3; ++axis) bound *= (component(box.max, axis) - component(box.min, axis)) / spacing + 1;
  return bound;
}

std::vector<Vec3d> random_packing(const Box3d& box, double spacing, std::uint64_t count, std::uint64_t seed) {
  HOOKE_ASSERT(spacing > 0, spacing);
  if (count == 0) return {};
  for (int axis = 0; axis < 3; ++axis) {
    if (component(box.max, axis) < component(box.min, axis)) return {};
  }
  return Packing(box, spacing, count, seed).run();
}

}  // namespace hooke::scene
