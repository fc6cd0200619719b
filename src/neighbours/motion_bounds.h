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
#include <span>
#include <vector>

#include "hooke/base/box3.h"
#include "hooke/base/parallel.h"
#include "hooke/base/vec3.h"
#include "hooke/neighbours/cell_grid.h"
#include "hooke/neighbours/reference_frame.h"
#include "hooke/neighbours/window_search.h"

namespace hooke {

/// How far particles may move from their reference frames before a neighbour list can miss a contact. An unlisted pair
/// was at least its contact distance and a skin apart; to touch now, the two particles must have moved by more than the
/// skin *relative to each other*. In a pool that sloshes as a whole, or a drop in free flight, they do not.
///
/// Consecutive particles form windows. Each window gets an reference frame, a point that moves steadily along with the
/// particles around. If neighbouring reference frames stay close to each other, and every particle stays close to its
/// window's reference frame, no unlisted pair can touch. This class bounds the first condition ahead of time, from the
/// boxes around the reference frames of blocks of space and their neighbours; the pass that moves particles checks the
/// second, with one comparison per particle. A particle further from its reference frame than its window allows needs
/// separate treatment; the other particles keep their list.
///
/// Particles in blocks that are not adjacent were at least a block apart. For them the same condition applies to blocks
/// several times as wide, with their distance in place of the skin, and so on for wider blocks.
template <class Real>
class MotionBounds {
 public:
  struct Limits {
    double diameter = 1;  ///< m, > 0, of the largest particle
    double skin = 0;  ///< m, >= 0, less a margin for rounding
    bool periodic[3]{};
    Vec3d min{}, max{};  ///< m, box around the points; a periodic axis must cover its whole period
  };

  using Frame = ReferenceFrame<Real>;

  /// An outlier beyond its buffer by less than this many skins touches only particles whose reference frames are close
  /// to its own; frames_apart() bounds their distance.
  static constexpr double kMild = 2;

  /// The summed motion of the particles of one window.
  struct WindowMotion {
    Vec3<Real> moved{Real(0), Real(0), Real(0)};  // m, since they were listed
    Vec3<Real> step{Real(0), Real(0), Real(0)};  // m, expected in the next step
    Real count{};
  };

  /// Takes the positions of the points when the list was built, m, in cell order; `window` (> 0) consecutive points are
  /// a window.
  void lay_out(const Vec3Columns<Real>& position_at_build, std::size_t count, std::size_t window, const Limits& limits);

  /// Lets reference frames follow the particles: motion(g) is the WindowMotion of window g. `reference frames` has at
  /// least one per window. Returns for how many steps from now the reference frames are valid; negative where they are
  /// not valid even now.
  template <class Motion>
  std::int64_t follow(const Motion& motion, std::span<Frame> frames) {
    clear_motions();
    parallel_ranges(window_count(), kGrain, [&](std::size_t first, std::size_t last) {
      std::array<WindowMotion, kGrain> motions;
      for (std::size_t start = first; start < last; start += kGrain) {
        const std::size_t count = std::min(kGrain, last - start);
        for (std::size_t k = 0; k < count; ++k) motions[k] = motion(start + k);
        add_motions(start, std::span(motions).first(count));
      }
    });
    return follow_motions(frames);
  }

  /// How far the reference frames around a window may be from its own reference frame after `steps` steps, m.
  double frames_apart(const Frame& frame, Real steps) const {
    return skin_ - 2 * static_cast<double>(frame.buffer - steps * frame.buffer_loss);
  }

  /// The box around the displacements of all reference frames after `steps` steps, m; Box3d::none() without any.
  Box3d frame_displacements(double steps) const {
    if (anywhere_.empty()) return Box3d::none();
    const auto edge = [&](std::size_t axis) {
      return static_cast<double>(anywhere_.edge[axis]) + steps * static_cast<double>(anywhere_.edge[axis + 3]);
    };
    return {{-edge(0), -edge(1), -edge(2)}, {edge(6), edge(7), edge(8)}};
  }

  /// The middle of all reference frames after `steps` steps, m, and the largest distance of an reference frame from it.
  Vec3<Real> middle(Real steps) const;
  double furthest_from_middle(double steps) const {
    return 0.5001 * (anywhere_.across(0) + steps * anywhere_.across(3));
  }

 private:
  static constexpr std::size_t kLevels = 4;
  static constexpr std::size_t kGrain = 64;  // windows

  // Bounds of offsets (m, 0 to 2) and drifts (m a step, 3 to 5); initially empty. The lower bounds, in front, are
  // stored with the opposite sign, so that all bounds grow.
  struct FrameRange {
    static constexpr Real kInfinite = std::numeric_limits<Real>::infinity();
    std::array<Real, 12> edge = {-kInfinite, -kInfinite, -kInfinite, -kInfinite, -kInfinite, -kInfinite,
                                 -kInfinite, -kInfinite, -kInfinite, -kInfinite, -kInfinite, -kInfinite};

    static FrameRange around(const Frame& a) {
      const Vec3<Real>&u = a.offset, &v = a.drift;
      return {{-u.x, -u.y, -u.z, -v.x, -v.y, -v.z, u.x, u.y, u.z, v.x, v.y, v.z}};
    }
    void add(const FrameRange& box) {
      for (std::size_t e = 0; e < 12; ++e) edge[e] = edge[e] < box.edge[e] ? box.edge[e] : edge[e];
    }
    bool empty() const { return edge[0] == -kInfinite; }
    // The largest difference of two offsets (first = 0) or drifts (3) in the box; 0 for an empty box.
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
    // Number of steps before two reference frames in the box can be further apart than `apart`; negative if they are
    // already.
    double steps_within(double apart) const {
      const double now = across(0), growth = across(3);
      if (!(now <= apart)) return -1;
      return growth > 0 ? (apart - now) / growth : std::numeric_limits<double>::infinity();
    }
  };

  // Sums over the windows in a block.
  struct Motions {
    std::array<Real, 7> sum{};
    void add(const Motions& other) {
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += other.sum[k];
    }
  };

  struct Level {
    CellGrid grid;
    double apart = 0;  // m: how far reference frames of blocks that are not adjacent may separate
    std::vector<FrameRange> boxes;
    std::array<std::vector<std::size_t>, 3> block_of;  // by index of a narrower block along an axis: a term of a key
  };

  static std::size_t count_of(const Level& level, int axis) {
    return static_cast<std::size_t>(level.grid.axis(axis).count);
  }
  static std::size_t stride_of(const Level& level, int axis) {
    std::size_t stride = 1;
    for (int a = 0; a < axis; ++a) stride *= count_of(level, a) + 2;
    return stride;
  }

  static void map_blocks(const Level& narrow, Level& wide);
  void find_blocks(const Vec3Columns<Real>& position_at_build, std::size_t count, std::size_t window);
  std::size_t window_count() const { return first_block_.size() - 1; }
  std::span<const std::uint32_t> blocks_of(std::size_t g) const {
    return std::span(blocks_).subspan(first_block_[g], first_block_[g + 1] - first_block_[g]);
  }

  // The steps of follow(): add motions of consecutive windows to their blocks, on any thread; then move the reference
  // frames.
  void clear_motions();
  void add_motions(std::size_t first, std::span<const WindowMotion> motions);
  std::int64_t follow_motions(std::span<Frame> frames);

  void place(std::span<Frame> frames);
  static void bound_wider_blocks(const Level& narrow, Level& wide);

  template <class T>
  static void spread(const Level& level, std::span<T> blocks, int axis);
  void allow(std::span<Frame> frames) const;

  std::array<Level, kLevels> levels_;
  double skin_ = 0;  // m
  FrameRange anywhere_;  // around all reference frames
  std::vector<Motions> motions_;
  std::vector<std::uint32_t> blocks_, first_block_;  // of each window
  std::mutex mutex_;  // guards sums over blocks
};

extern template class MotionBounds<float>;
extern template class MotionBounds<double>;

}  // namespace hooke
