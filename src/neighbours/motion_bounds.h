// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <vector>

#include "hooke/base/parallel.h"
#include "hooke/base/vec3.h"
#include "hooke/neighbours/cell_grid.h"
#include "hooke/neighbours/group_search.h"

namespace hooke {

/// Whether a neighbour list can still be trusted, by how particles moved relative to their surroundings. A pair that is
/// not on the list was at least its contact distance and a skin apart; to touch now, the two must have moved by more
/// than the skin *relative to each other*. A pool that sloshes as a whole, or a drop in free flight, does not.
///
/// The displacements since the list was built are bounded by boxes: one for each block of space, four diameters wide.
/// Where the box around a block's and its neighbours' displacements is smaller than the skin across, no pair in them
/// can touch. Particles in blocks that are not adjacent were at least a block apart; for them the same is asked of
/// blocks four times as wide, with the smaller blocks' width in place of the skin, and so on.
template <class Real>
class MotionBounds {
 public:
  struct Limits {
    double diameter = 1;  ///< m, the largest
    double skin = 0;  ///< m, less what rounding may take
    bool periodic[3]{};
    Vec3d min{}, max{};  ///< m, box around the points; of a periodic axis its whole period
  };

  /// Takes the places of the points when the list was built, m, in cell order.
  void lay_out(const Columns<Real>& listed_at, std::size_t count, const Limits& limits) {
    const auto most_blocks = static_cast<std::uint64_t>(std::max<std::size_t>(4096, count / 16));
    double width = 4 * limits.diameter;
    double allowed = limits.skin;
    for (Level& level : levels_) {
      for (;; width *= 2) {  // a sparse cloud gets wider blocks: that errs on the safe side
        level.grid.lay_out(limits.min, limits.max, limits.periodic, width);
        if (level.grid.key_end() < most_blocks) break;
      }
      level.boxes.assign(level.grid.key_end() + 1, Box{});
      level.allowed = allowed;
      allowed = 0.999 * (width - limits.diameter);
      width *= 4;
    }
    allowed_anywhere_ = allowed;

    runs_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3d at = vec_cast<double>(Vec3<Real>{listed_at.x[i], listed_at.y[i], listed_at.z[i]});
      Run run{static_cast<std::uint32_t>(i), {}};
      for (std::size_t l = 0; l < kLevels; ++l) {
        run.block[l] = static_cast<std::uint32_t>(levels_[l].grid.key_of(at));
      }
      if (runs_.empty() || runs_.back().block != run.block) runs_.push_back(run);
    }
    count_ = count;
  }

  /// True where an unlisted pair may touch. `displacement(i, u)` puts point i's displacement since lay_out() (m) into u
  /// and returns true, or false for a point that is gone. What is not finite counts as having moved too far.
  template <class Displacement>
  bool unlisted_pair_may_touch(const Displacement& displacement) {
    for (Level& level : levels_) std::fill(level.boxes.begin(), level.boxes.end(), Box{});
    bound_blocks(displacement);
    Box anywhere;
    for (const Box& box : levels_.back().boxes) anywhere.add(box);
    if (!anywhere.narrower_than(allowed_anywhere_)) return true;
    return std::any_of(levels_.begin(), levels_.end(), [](const Level& level) { return level_may_touch(level); });
  }

 private:
  static constexpr std::size_t kLevels = 3;

  // Bounds of displacements, m; empty at first.
  struct Box {
    Vec3<Real> min{kInfinite, kInfinite, kInfinite};
    Vec3<Real> max{-kInfinite, -kInfinite, -kInfinite};
    static constexpr Real kInfinite = std::numeric_limits<Real>::infinity();

    void add(const Vec3<Real>& u) {
      min = {std::min(min.x, u.x), std::min(min.y, u.y), std::min(min.z, u.z)};
      max = {std::max(max.x, u.x), std::max(max.y, u.y), std::max(max.z, u.z)};
    }
    void add(const Box& box) {
      min = {std::min(min.x, box.min.x), std::min(min.y, box.min.y), std::min(min.z, box.min.z)};
      max = {std::max(max.x, box.max.x), std::max(max.y, box.max.y), std::max(max.z, box.max.z)};
    }
    bool empty() const { return min.x > max.x; }
    // Whether any two displacements in the box differ by less than `distance`; false where one is infinite.
    bool narrower_than(double distance) const {
      if (empty()) return true;
      const Vec3d across = vec_cast<double>(max) - vec_cast<double>(min);
      return dot(across, across) < distance * distance;
    }
  };

  // Consecutive points in the same block of every level.
  struct Run {
    std::uint32_t first;
    std::array<std::uint32_t, kLevels> block;
  };

  struct Level {
    CellGrid grid;
    double allowed = 0;  // m: relative displacement that leaves the pairs of adjacent blocks untouched
    std::vector<Box> boxes;
  };

  // The box of every block of every level.
  template <class Displacement>
  void bound_blocks(const Displacement& displacement) {
    constexpr std::size_t kGrain = 256;
    parallel_ranges(runs_.size(), kGrain, [&](std::size_t first, std::size_t last) {
      for (std::size_t start = first; start < last; start += kGrain) {
        const std::size_t end = std::min(start + kGrain, last);
        std::array<Box, kGrain> boxes;
        for (std::size_t r = start; r < end; ++r) boxes[r - start] = bound_run(r, displacement);
        const std::lock_guard lock(mutex_);
        for (std::size_t r = start; r < end; ++r) {
          for (std::size_t l = 0; l < kLevels; ++l) levels_[l].boxes[runs_[r].block[l]].add(boxes[r - start]);
        }
      }
    });
  }

  template <class Displacement>
  Box bound_run(std::size_t r, const Displacement& displacement) const {
    Box box;
    const std::size_t end = r + 1 < runs_.size() ? runs_[r + 1].first : count_;
    for (std::size_t i = runs_[r].first; i < end; ++i) {
      Vec3<Real> u;
      if (!displacement(i, u)) continue;
      if (!std::isfinite(u.x) || !std::isfinite(u.y) || !std::isfinite(u.z)) u = Box{}.min;  // infinite
      box.add(u);
    }
    return box;
  }

  static bool level_may_touch(const Level& level) {
    for (std::uint64_t block = 0; block < level.boxes.size(); ++block) {
      if (level.boxes[block].empty()) continue;
      CellGrid::KeyRange ranges[18];
      const std::size_t range_count = level.grid.neighbour_ranges(block, ranges);
      Box around;
      for (std::size_t r = 0; r < range_count; ++r) {
        for (std::uint64_t k = ranges[r].first; k <= ranges[r].last; ++k) around.add(level.boxes[k]);
      }
      if (!around.narrower_than(level.allowed)) return true;
    }
    return false;
  }

  std::array<Level, kLevels> levels_;
  double allowed_anywhere_ = 0;  // m
  std::vector<Run> runs_;
  std::mutex mutex_;  // around the boxes
  std::size_t count_ = 0;
};

}  // namespace hooke
