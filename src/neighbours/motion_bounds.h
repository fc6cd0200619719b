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
#include <mutex>
#include <span>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"
#include "hooke/base/vec3.h"
#include "hooke/neighbours/cell_grid.h"
#include "hooke/neighbours/group_anchor.h"
#include "hooke/neighbours/window_search.h"

namespace hooke {

/// How far particles may stray before a neighbour list can miss a contact. A pair that is not on the list was at least
/// its contact distance and a skin apart; to touch now, the two must have moved by more than the skin *relative to each
/// other*. A pool that sloshes as a whole, or a drop in free flight, does not.
///
/// Consecutive particles form groups, and each group gets an anchor, a point that moves at a steady pace along with the
/// particles around: where neighbouring anchors stay close to each other, and every particle stays close to its group's
/// anchor, no unlisted pair can touch. The first is bounded here, ahead of time, from the boxes around the anchors of
/// blocks of space and their neighbours; the second is for the pass that moves particles to see, one comparison each. A
/// particle that strays further than its group allows needs looking after by other means; the rest keep their list.
///
/// Particles in blocks that are not adjacent were at least a block apart; for them the same is asked of blocks some
/// times as wide, with what they were apart in place of the skin, and so on.
template <class Real>
class MotionBounds {
 public:
  struct Limits {
    double diameter = 1;  ///< m, > 0, the largest
    double skin = 0;  ///< m, >= 0, less what rounding may take
    bool periodic[3]{};
    Vec3d min{}, max{};  ///< m, box around the points; of a periodic axis its whole period
  };

  using Anchor = GroupAnchor<Real>;

  /// A particle that strays by less than so many skins touches only particles whose anchors are close to its own:
  /// anchors_apart() bounds how far from it they are.
  static constexpr double kMild = 2;

  /// The motion of the particles of one group, summed.
  struct GroupMotion {
    Vec3<Real> moved{Real(0), Real(0), Real(0)};  // m, since they were listed
    Vec3<Real> step{Real(0), Real(0), Real(0)};  // m, in the next step as far as one can tell
    Real count{};
  };

  /// Takes the places of the points when the list was built, m, in cell order; `group` (> 0) consecutive ones are a
  /// group.
  void lay_out(const Columns<Real>& listed_at, std::size_t count, std::size_t group, const Limits& limits) {
    HOOKE_ASSERT(group > 0);
    HOOKE_ASSERT(limits.diameter > 0 && limits.skin >= 0, limits.diameter, limits.skin);
    const std::size_t most_blocks = std::max<std::size_t>(4096, count / 4);
    skin_ = limits.skin;
    double width = 4 * limits.diameter;
    double blur = 0;  // m: how far two points are from the middles of the blocks by which they count to this level
    for (Level& level : levels_) {
      for (;; width *= 1.25) {  // a sparse cloud gets wider blocks: that errs on the safe side
        level.grid.lay_out(limits.min, limits.max, limits.periodic, width);
        if (level.grid.key_end() < most_blocks) break;
      }
      level.apart = std::max(0.0, 0.999 * (width - blur - limits.diameter) - (kMild + 0.5) * skin_);
      const double widest = std::max({level.grid.axis(0).cell, level.grid.axis(1).cell, level.grid.axis(2).cell});
      blur += widest;
      width = 2.5 * widest;
    }
    for (std::size_t l = 1; l < kLevels; ++l) map_blocks(levels_[l - 1], levels_[l]);
    find_blocks(listed_at, count, group);
  }

  /// Lets anchors follow the particles: motion(g) is the GroupMotion of group g. `anchors` has one for each group, or
  /// more. Returns for how many steps from now they are good; negative where they are not even now.
  template <class Motion>
  std::int64_t follow(const Motion& motion, std::span<Anchor> anchors) {
    HOOKE_ASSERT(anchors.size() >= group_count(), anchors.size(), group_count());
    average(motion);
    for (Level& level : levels_) level.boxes.assign(level.grid.key_end(), Box{});
    place(anchors);
    for (std::size_t l = 1; l < kLevels; ++l) bound_wider_blocks(levels_[l - 1], levels_[l]);
    anywhere_ = Box{};
    for (const Box& box : levels_.back().boxes) anywhere_.add(box);
    double steps = anywhere_.steps_within(levels_.back().apart);
    if (!(anywhere_.furthest() < 1000 * skin_)) steps = -1;  // rounding would take too much of the skin
    for (std::size_t l = 0; l < kLevels; ++l) {
      for (int axis = 0; axis < 3; ++axis) spread(levels_[l], std::span(levels_[l].boxes), axis);
      if (l == 0) continue;
      for (const Box& box : levels_[l].boxes) steps = std::min(steps, box.steps_within(levels_[l - 1].apart));
    }
    allow(anchors);
    return steps < 0 ? -1 : static_cast<std::int64_t>(std::min(steps, 1e6));
  }

  /// How far the anchors around a group may be from its own after so many steps, m.
  double anchors_apart(const Anchor& anchor, Real steps) const {
    return skin_ - 2 * static_cast<double>(anchor.allowance - steps * anchor.shrink);
  }

  /// The middle between all anchors after so many steps, m, and how far from it any of them is at most.
  Vec3<Real> middle(Real steps) const {
    const auto mean = [&](std::size_t axis) {
      const Real moved = (anywhere_.edge[axis + 6] - anywhere_.edge[axis]) / 2;
      return moved + steps * (anywhere_.edge[axis + 9] - anywhere_.edge[axis + 3]) / 2;
    };
    return anywhere_.empty() ? Vec3<Real>{Real(0), Real(0), Real(0)} : Vec3<Real>{mean(0), mean(1), mean(2)};
  }
  double furthest_from_middle(double steps) const {
    return 0.5001 * (anywhere_.across(0) + steps * anywhere_.across(3));
  }

 private:
  static constexpr std::size_t kLevels = 4;
  static constexpr std::size_t kGrain = 64;  // groups

  // Bounds of offsets (m, 0 to 2) and drifts (m a step, 3 to 5); empty at first. The lower ones, in front, are kept
  // with the opposite sign, so that all grow.
  struct Box {
    static constexpr Real kInfinite = std::numeric_limits<Real>::infinity();
    std::array<Real, 12> edge = {-kInfinite, -kInfinite, -kInfinite, -kInfinite, -kInfinite, -kInfinite,
                                 -kInfinite, -kInfinite, -kInfinite, -kInfinite, -kInfinite, -kInfinite};

    static Box around(const Anchor& a) {
      const Vec3<Real>&u = a.offset, &v = a.drift;
      return {{-u.x, -u.y, -u.z, -v.x, -v.y, -v.z, u.x, u.y, u.z, v.x, v.y, v.z}};
    }
    void add(const Box& box) {
      for (std::size_t e = 0; e < 12; ++e) edge[e] = edge[e] < box.edge[e] ? box.edge[e] : edge[e];
    }
    bool empty() const { return edge[0] == -kInfinite; }
    // The most that two offsets (first = 0) or drifts (3) in the box can differ by; 0 where it is empty.
    double across(std::size_t first) const {
      double sum = 0;
      for (std::size_t axis = first; axis < first + 3; ++axis) {
        const double across = static_cast<double>(edge[axis]) + static_cast<double>(edge[axis + 6]);
        if (!empty()) sum += across * across;
      }
      return std::sqrt(sum);
    }
    double furthest() const {
      double most = 0;
      for (std::size_t axis = 0; axis < 3 && !empty(); ++axis) {
        most =
            std::max({most, std::abs(static_cast<double>(edge[axis])), std::abs(static_cast<double>(edge[axis + 6]))});
      }
      return most;
    }
    // How many steps pass before two anchors in the box can be further than `apart` from each other; negative: none.
    double steps_within(double apart) const {
      const double now = across(0), growth = across(3);
      if (!(now <= apart)) return -1;
      return growth > 0 ? (apart - now) / growth : std::numeric_limits<double>::infinity();
    }
  };

  // Sums over the groups of a block.
  struct Motions {
    std::array<Real, 7> sum{};
    void add(const Motions& other) {
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += other.sum[k];
    }
  };

  struct Level {
    CellGrid grid;
    double apart = 0;  // m: how far anchors of blocks that are not adjacent may move away from each other
    std::vector<Box> boxes;
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

  // The narrowest blocks that the points of each group are in.
  void find_blocks(const Columns<Real>& listed_at, std::size_t count, std::size_t group) {
    const std::size_t groups = (count + group - 1) / group;
    std::vector<std::vector<std::uint32_t>> chunks((groups + kGrain - 1) / kGrain);
    first_block_.assign(groups + 1, 0);
    parallel_ranges(groups, kGrain, [&](std::size_t first, std::size_t last) {
      std::vector<std::uint32_t> keys(kGrain * group);
      for (std::size_t start = first; start < last; start += kGrain) {
        std::vector<std::uint32_t>& blocks = chunks[start / kGrain];
        const std::size_t end = std::min(start + kGrain, last);
        levels_[0].grid.keys_of(listed_at, start * group, std::min(end * group, count), keys.data());
        for (std::size_t g = start; g < end; ++g) {
          const auto before = static_cast<std::ptrdiff_t>(blocks.size());
          for (std::size_t i = g * group; i < std::min((g + 1) * group, count); ++i) {
            const std::uint32_t block = keys[i - start * group];
            const bool same = static_cast<std::ptrdiff_t>(blocks.size()) > before && blocks.back() == block;
            if (!same && std::find(blocks.begin() + before, blocks.end(), block) == blocks.end())
              blocks.push_back(block);
          }
          first_block_[g + 1] = static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(blocks.size()) - before);
        }
      }
    });
    for (std::size_t g = 0; g < groups; ++g) first_block_[g + 1] += first_block_[g];
    blocks_.clear();
    blocks_.reserve(first_block_.back());
    for (const auto& blocks : chunks) blocks_.insert(blocks_.end(), blocks.begin(), blocks.end());
  }
  std::size_t group_count() const { return first_block_.size() - 1; }
  std::span<const std::uint32_t> blocks_of(std::size_t g) const {
    return std::span(blocks_).subspan(first_block_[g], first_block_[g + 1] - first_block_[g]);
  }

  // Sums of motion over each block and its neighbours.
  template <class Motion>
  void average(const Motion& motion) {
    motions_.assign(levels_[0].grid.key_end(), Motions{});
    parallel_ranges(group_count(), kGrain, [&](std::size_t first, std::size_t last) {
      for (std::size_t start = first; start < last; start += kGrain) {
        const std::size_t end = std::min(start + kGrain, last);
        std::array<Motions, kGrain> sums;
        for (std::size_t g = start; g < end; ++g) {
          const GroupMotion m = motion(g);
          sums[g - start].sum = {m.moved.x, m.moved.y, m.moved.z, m.step.x, m.step.y, m.step.z, m.count};
        }
        const std::lock_guard lock(mutex_);
        for (std::size_t g = start; g < end; ++g) {
          for (const std::uint32_t block : blocks_of(g)) motions_[block].add(sums[g - start]);
        }
      }
    });
    for (int axis = 0; axis < 3; ++axis) spread(levels_[0], std::span(motions_), axis);
  }

  // Gives each group the mean motion of its surroundings, and each block the box around its groups' anchors.
  void place(std::span<Anchor> anchors) {
    parallel_ranges(group_count(), kGrain, [&](std::size_t first, std::size_t last) {
      for (std::size_t g = first; g < last; ++g) {
        Motions around;
        for (const std::uint32_t block : blocks_of(g)) around.add(motions_[block]);
        const auto& s = around.sum;
        const Real scale = s[6] > Real(0) ? Real(1) / s[6] : Real(0);
        anchors[g].offset = {scale * s[0], scale * s[1], scale * s[2]};
        anchors[g].drift = {scale * s[3], scale * s[4], scale * s[5]};
      }
      const std::lock_guard lock(mutex_);
      for (std::size_t g = first; g < last; ++g) {
        for (const std::uint32_t block : blocks_of(g)) levels_[0].boxes[block].add(Box::around(anchors[g]));
      }
    });
  }

  static void bound_wider_blocks(const Level& narrow, Level& wide) {
    for (std::size_t z = 1; z <= count_of(narrow, 2); ++z) {
      for (std::size_t y = 1; y <= count_of(narrow, 1); ++y) {
        const Box* from = narrow.boxes.data() + z * stride_of(narrow, 2) + y * stride_of(narrow, 1);
        Box* to = wide.boxes.data() + wide.block_of[2][z] + wide.block_of[1][y];
        for (std::size_t x = 1; x <= count_of(narrow, 0); ++x) to[wide.block_of[0][x]].add(from[x]);
      }
    }
  }

  // Adds to each block what its two neighbours along the axis hold.
  template <class T>
  static void spread(const Level& level, std::span<T> blocks, int axis) {
    const std::size_t n = count_of(level, axis), stride = stride_of(level, axis);
    const int across = axis == 0 ? 1 : 0, up = axis == 2 ? 1 : 2;
    const std::size_t across_stride = stride_of(level, across), up_stride = stride_of(level, up);
    const bool periodic = level.grid.axis(axis).periodic;
    parallel_ranges(count_of(level, up), 1, [&](std::size_t first, std::size_t last) {
      constexpr std::size_t kSideBySide = 8;  // lines: next to each other in memory where they run along y or z
      for (std::size_t u = first + 1; u <= last; ++u) {
        for (std::size_t c = 1; c <= count_of(level, across); c += kSideBySide) {
          const std::size_t lines = std::min(kSideBySide, count_of(level, across) + 1 - c);
          T* const start = blocks.data() + u * up_stride + c * across_stride;
          std::array<T, kSideBySide> before{}, front{};
          for (std::size_t k = 0; k < lines && periodic; ++k) {
            before[k] = start[k * across_stride + n * stride];
            front[k] = start[k * across_stride + stride];
          }
          for (std::size_t i = 1; i <= n; ++i) {
            for (std::size_t k = 0; k < lines; ++k) {
              T& block = start[k * across_stride + i * stride];
              const T own = block;
              block.add(before[k]);
              block.add(i < n ? (&block)[stride] : front[k]);
              before[k] = own;
            }
          }
        }
      }
    });
  }

  // What neighbouring anchors leave of the skin, half for each of a pair.
  void allow(std::span<Anchor> anchors) const {
    parallel_ranges(group_count(), kGrain, [&](std::size_t first, std::size_t last) {
      for (std::size_t g = first; g < last; ++g) {
        double apart = 0, growth = 0;
        for (const std::uint32_t block : blocks_of(g)) {
          apart = std::max(apart, levels_[0].boxes[block].across(0));
          growth = std::max(growth, levels_[0].boxes[block].across(3));
        }
        anchors[g].allowance = static_cast<Real>((skin_ - apart) / 2);
        anchors[g].shrink = static_cast<Real>(growth / 2);
      }
    });
  }

  std::array<Level, kLevels> levels_;
  double skin_ = 0;  // m
  Box anywhere_;  // around all anchors
  std::vector<Motions> motions_;
  std::vector<std::uint32_t> blocks_, first_block_;  // of each group
  std::mutex mutex_;  // around what is summed up in blocks
};

}  // namespace hooke
