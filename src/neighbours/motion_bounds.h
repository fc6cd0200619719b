// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "hooke/base/parallel.h"
#include "hooke/base/vec3.h"
#include "hooke/neighbours/cell_grid.h"
#include "hooke/neighbours/group_search.h"

namespace hooke {

/// How much of a neighbour list can still be trusted.
enum class Trust {
  none,  ///< build it anew
  some,  ///< all but the rows of some groups, which a search in the cells of the last build completes
  all,
};

/// Whether a neighbour list can still be trusted, by how particles moved relative to their surroundings. A pair that is
/// not on the list was at least its contact distance and a skin apart; to touch now, the two must have moved by more
/// than the skin *relative to each other*. A pool that sloshes as a whole, or a drop in free flight, does not.
///
/// The displacements since the list was built are bounded by boxes: one for each block of space, not quite two
/// diameters wide. Where the box around a block's and its neighbours' displacements is smaller than the skin across, no
/// unlisted pair in them can touch. Particles in blocks that are not adjacent were at least a block apart; for them the
/// same is asked of blocks some times as wide, with what they were apart in place of the skin, and so on.
///
/// A block that fails is restless, and so are those around it: a pair that may touch is in two restless blocks. As long
/// as the two moved by less than `found` relative to each other, a search around where they were finds both.
template <class Real>
class MotionBounds {
 public:
  struct Limits {
    double diameter = 1;  ///< m, the largest
    double skin = 0;  ///< m, less what rounding may take
    double found = 0;  ///< m: whoever moved by less relative to each other is found by a new search; 0 for nobody
    bool periodic[3]{};
    Vec3d min{}, max{};  ///< m, box around the points; of a periodic axis its whole period
  };

  /// Takes the places of the points when the list was built, m, in cell order.
  void lay_out(const Columns<Real>& listed_at, std::size_t count, const Limits& limits) {
    const std::size_t most_blocks = std::max<std::size_t>(4096, count);
    found_ = limits.found;
    double width = 1.75 * limits.diameter;
    double apart = limits.skin;
    double blur = 0;  // m: how far two points are from the middles of the blocks by which they count to this level
    for (Level& level : levels_) {
      for (;; width *= 1.25) {  // a sparse cloud gets wider blocks: that errs on the safe side
        level.grid.lay_out(limits.min, limits.max, limits.periodic, width);
        if (level.grid.key_end() < most_blocks) break;
      }
      level.states.resize(level.grid.key_end());
      level.apart = apart;
      apart = std::max(0.0, 0.999 * (width - blur - limits.diameter));
      const double widest = std::max({level.grid.axis(0).cell, level.grid.axis(1).cell, level.grid.axis(2).cell});
      blur += widest;
      width = 2.5 * widest;
    }
    apart_anywhere_ = apart;
    for (std::size_t l = 1; l < kLevels; ++l) map_blocks(levels_[l - 1], levels_[l]);

    constexpr std::size_t kChunk = 4096;  // points
    std::vector<std::vector<Run>> chunks((count + kChunk - 1) / kChunk);
    parallel_ranges(count, kChunk, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        std::vector<Run>& runs = chunks[i / kChunk];
        const Vec3d at = vec_cast<double>(Vec3<Real>{listed_at.x[i], listed_at.y[i], listed_at.z[i]});
        const auto block = static_cast<std::uint32_t>(levels_[0].grid.key_of(at));
        if (runs.empty() || runs.back().block != block) runs.push_back({static_cast<std::uint32_t>(i), block});
      }
    });
    std::size_t run_count = 0;
    for (const std::vector<Run>& runs : chunks) run_count += runs.size();
    runs_.clear();
    runs_.reserve(run_count);
    for (const std::vector<Run>& runs : chunks) runs_.insert(runs_.end(), runs.begin(), runs.end());
    count_ = count;
  }

  /// How far the list can be trusted. `displacement(i, u)` puts point i's displacement since lay_out() (m) into u and
  /// returns true, or false for a point that is gone. What is not finite counts as having moved too far. Under
  /// Trust::some `restless[i / group]` is 1 where point i may touch one that is not on the list, else 0. Works in
  /// `scratch` where that is aligned and large enough (a dozen numbers a block do), else in memory of its own.
  template <class Displacement>
  Trust judge(const Displacement& displacement, std::size_t group, std::vector<unsigned char>& restless,
              std::span<std::byte> scratch = {}) {
    lend_boxes(scratch);
    bound_blocks(displacement);
    for (std::size_t l = 1; l < kLevels; ++l) bound_wider_blocks(levels_[l - 1], levels_[l]);
    Box anywhere;
    for (const Box& box : levels_.back().boxes) anywhere.add(box);
    if (state_of(anywhere, apart_anywhere_) != State::quiet) return Trust::none;
    for (std::size_t l = kLevels; l-- > 0;) {
      for (int axis = 0; axis < 3; ++axis) widen_boxes(levels_[l], axis);
      find_states(levels_[l], l + 1 < kLevels ? &levels_[l + 1] : nullptr);
    }
    return mark_restless(group, restless);
  }

 private:
  static constexpr std::size_t kLevels = 4;
  static constexpr std::size_t kGrain = 256;  // runs

  enum class State : unsigned char { quiet, restless, lost };  // each includes the one before

  // Bounds of displacements, m; empty at first. The lower ones are kept with the opposite sign, so that all six grow.
  struct Box {
    static constexpr Real kInfinite = std::numeric_limits<Real>::infinity();
    Real edge[6] = {-kInfinite, -kInfinite, -kInfinite, -kInfinite, -kInfinite, -kInfinite};

    void add(const Vec3<Real>& u) { add(Box{{-u.x, -u.y, -u.z, u.x, u.y, u.z}}); }
    void add(const Box& box) {
      for (int e = 0; e < 6; ++e) edge[e] = edge[e] < box.edge[e] ? box.edge[e] : edge[e];
    }
    // The most that two displacements in the box can differ by, squared; 0 where it is empty.
    double across2() const {
      double sum = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const double across = std::max(0.0, static_cast<double>(edge[axis]) + static_cast<double>(edge[axis + 3]));
        sum += across * across;
      }
      return sum;
    }
  };

  // Consecutive points in the same block of the narrowest level.
  struct Run {
    std::uint32_t first, block;
  };

  struct Level {
    CellGrid grid;
    double apart = 0;  // m: relative displacement that leaves the pairs of adjacent blocks untouched
    std::span<Box> boxes;  // lent for the time of a judgement
    std::vector<State> states;
    std::array<std::vector<std::size_t>, 3> block_of;  // by a narrower block's index along an axis: a term of a key
  };

  static std::size_t count_of(const Level& level, int axis) {
    return static_cast<std::size_t>(level.grid.axis(axis).count);
  }
  static std::size_t stride_of(const Level& level, int axis) {
    std::size_t stride = 1;
    for (int a = 0; a < axis; ++a) stride *= count_of(level, a) + 2;
    return stride;
  }

  // Which wider block a narrow one counts to: the one that its middle is in.
  static void map_blocks(const Level& narrow, Level& wide) {
    for (int axis = 0; axis < 3; ++axis) {
      const CellGrid::Axis& from = narrow.grid.axis(axis);
      const CellGrid::Axis& to = wide.grid.axis(axis);
      auto& block_of = wide.block_of[static_cast<std::size_t>(axis)];
      block_of.assign(static_cast<std::size_t>(from.count) + 2, 0);
      for (std::int64_t i = 1; i <= from.count; ++i) {
        const auto at = static_cast<std::int64_t>((static_cast<double>(i) - 0.5) * from.cell / to.cell) + 1;
        block_of[static_cast<std::size_t>(i)] =
            static_cast<std::size_t>(std::min(at, to.count)) * stride_of(wide, axis);
      }
    }
  }

  // body(narrow block, wide block) for all blocks of a row along x of the narrow level.
  template <class Body>
  static void for_row(const Level& narrow, const Level& wide, std::size_t row, const Body& body) {
    const std::size_t y = row % count_of(narrow, 1) + 1, z = row / count_of(narrow, 1) + 1;
    const std::size_t block = z * stride_of(narrow, 2) + y * stride_of(narrow, 1);
    const std::size_t wide_block = wide.block_of[2][z] + wide.block_of[1][y];
    for (std::size_t x = 1; x <= count_of(narrow, 0); ++x) body(block + x, wide_block + wide.block_of[0][x]);
  }
  static std::size_t rows_of(const Level& level) { return count_of(level, 1) * count_of(level, 2); }

  // Gives every level its boxes, empty.
  void lend_boxes(std::span<std::byte> scratch) {
    std::size_t needed = 0;
    for (const Level& level : levels_) needed += level.grid.key_end();
    auto* boxes = reinterpret_cast<Box*>(scratch.data());
    if (scratch.size() < needed * sizeof(Box) || reinterpret_cast<std::uintptr_t>(boxes) % alignof(Box) != 0) {
      own_boxes_.resize(needed);
      boxes = own_boxes_.data();
    }
    parallel_ranges(needed, 4096, [&](std::size_t first, std::size_t last) {
      std::uninitialized_fill(boxes + first, boxes + last, Box{});
    });
    for (Level& level : levels_) {
      level.boxes = {boxes, level.grid.key_end()};
      boxes += level.boxes.size();
    }
  }

  // The box of every narrowest block.
  template <class Displacement>
  void bound_blocks(const Displacement& displacement) {
    parallel_ranges(runs_.size(), kGrain, [&](std::size_t first, std::size_t last) {
      for (std::size_t start = first; start < last; start += kGrain) {
        const std::size_t end = std::min(start + kGrain, last);
        std::array<Box, kGrain> boxes;
        for (std::size_t r = start; r < end; ++r) boxes[r - start] = bound_run(r, displacement);
        const std::lock_guard lock(mutex_);
        for (std::size_t r = start; r < end; ++r) levels_[0].boxes[runs_[r].block].add(boxes[r - start]);
      }
    });
  }

  std::size_t end_of(std::size_t run) const { return run + 1 < runs_.size() ? runs_[run + 1].first : count_; }

  template <class Displacement>
  Box bound_run(std::size_t r, const Displacement& displacement) const {
    Box box;
    Real finite = 0;  // stays 0 while everything is
    for (std::size_t i = runs_[r].first; i < end_of(r); ++i) {
      Vec3<Real> u;
      if (!displacement(i, u)) continue;
      finite += Real(0) * (u.x + u.y + u.z);
      box.add(u);
    }
    if (finite != 0) std::fill(std::begin(box.edge), std::end(box.edge), Box::kInfinite);
    return box;
  }

  static void bound_wider_blocks(const Level& narrow, Level& wide) {
    for (std::size_t row = 0; row < rows_of(narrow); ++row) {
      for_row(narrow, wide, row, [&](std::size_t n, std::size_t w) { wide.boxes[w].add(narrow.boxes[n]); });
    }
  }

  // Each block's box around those of its two neighbours along the axis too.
  static void widen_boxes(Level& level, int axis) {
    const std::size_t n = count_of(level, axis), stride = stride_of(level, axis);
    const int across = axis == 0 ? 1 : 0, up = axis == 2 ? 1 : 2;
    const std::size_t across_stride = stride_of(level, across), up_stride = stride_of(level, up);
    const bool periodic = level.grid.axis(axis).periodic;
    parallel_ranges(count_of(level, up), 1, [&](std::size_t first, std::size_t last) {
      constexpr std::size_t kSideBySide = 8;  // lines: next to each other in memory where they run along y or z
      for (std::size_t u = first + 1; u <= last; ++u) {
        for (std::size_t c = 1; c <= count_of(level, across); c += kSideBySide) {
          const std::size_t lines = std::min(kSideBySide, count_of(level, across) + 1 - c);
          Box* const start = level.boxes.data() + u * up_stride + c * across_stride;
          std::array<Box, kSideBySide> before{}, front{};
          for (std::size_t k = 0; k < lines && periodic; ++k) {
            before[k] = start[k * across_stride + n * stride];
            front[k] = start[k * across_stride + stride];
          }
          for (std::size_t i = 1; i <= n; ++i) {
            for (std::size_t k = 0; k < lines; ++k) {
              Box& box = start[k * across_stride + i * stride];
              const Box own = box;
              box.add(before[k]);
              box.add(i < n ? (&box)[stride] : front[k]);
              before[k] = own;
            }
          }
        }
      }
    });
  }

  State state_of(const Box& box, double apart) const {
    const double across2 = box.across2();
    if (across2 < apart * apart) return State::quiet;
    return across2 < found_ * found_ ? State::restless : State::lost;
  }

  // By the blocks' own boxes, and at least what the wider level's are.
  void find_states(Level& level, const Level* wide) const {
    if (wide == nullptr) {
      for (std::size_t b = 0; b < level.boxes.size(); ++b) level.states[b] = state_of(level.boxes[b], level.apart);
      return;
    }
    parallel_ranges(rows_of(level), 16, [&](std::size_t first, std::size_t last) {
      for (std::size_t row = first; row < last; ++row) {
        for_row(level, *wide, row, [&](std::size_t n, std::size_t w) {
          level.states[n] = std::max(wide->states[w], state_of(level.boxes[n], level.apart));
        });
      }
    });
  }

  // The states of blocks that hold points become those of groups.
  Trust mark_restless(std::size_t group, std::vector<unsigned char>& restless) const {
    restless.assign((count_ + group - 1) / group, 0);
    State worst = State::quiet;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      const State state = levels_[0].states[runs_[r].block];
      if (state == State::quiet) continue;
      worst = std::max(worst, state);
      for (std::size_t g = runs_[r].first / group; g <= (end_of(r) - 1) / group; ++g) restless[g] = 1;
    }
    return worst == State::lost ? Trust::none : worst == State::restless ? Trust::some : Trust::all;
  }

  std::array<Level, kLevels> levels_;
  double apart_anywhere_ = 0;  // m
  double found_ = 0;  // m
  std::vector<Box> own_boxes_;  // where no scratch is given
  std::vector<Run> runs_;
  std::mutex mutex_;  // around the boxes
  std::size_t count_ = 0;
};

}  // namespace hooke
