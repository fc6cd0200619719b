// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/neighbours/motion_bounds.h"

#include <algorithm>
#include <cstddef>
#include <mutex>

#include "hooke/base/assert.h"

namespace hooke {

template <class Real>
void MotionBounds<Real>::lay_out(const Vec3Columns<Real>& position_at_build, std::size_t count, std::size_t window,
                                 const Limits& limits) {
  HOOKE_ASSERT(window > 0);
  HOOKE_ASSERT(limits.diameter > 0 && limits.skin >= 0, limits.diameter, limits.skin);
  const std::size_t most_blocks = std::max<std::size_t>(4096, count / 4);
  skin_ = limits.skin;
  double width = 4 * limits.diameter;
  double blur = 0;  // m: distance of two points from the middles of the blocks that map them to this level
  for (Level& level : levels_) {
    for (;; width *= 1.25) {  // a sparse cloud gets wider blocks, which is safe
      level.grid.lay_out(limits.min, limits.max, limits.periodic, width);
      if (level.grid.key_end() < most_blocks) break;
    }
    level.apart = std::max(0.0, 0.999 * (width - blur - limits.diameter) - (kMild + 0.5) * skin_);
    const double widest = std::max({level.grid.axis(0).cell, level.grid.axis(1).cell, level.grid.axis(2).cell});
    blur += widest;
    width = 2.5 * widest;
  }
  for (std::size_t l = 1; l < kLevels; ++l) map_blocks(levels_[l - 1], levels_[l]);
  find_blocks(position_at_build, count, window);
}

template <class Real>
Vec3<Real> MotionBounds<Real>::middle(Real steps) const {
  const auto mean = [&](std::size_t axis) {
    const Real moved = (anywhere_.edge[axis + 6] - anywhere_.edge[axis]) / 2;
    return moved + steps * (anywhere_.edge[axis + 9] - anywhere_.edge[axis + 3]) / 2;
  };
  return anywhere_.empty() ? Vec3<Real>{Real(0), Real(0), Real(0)} : Vec3<Real>{mean(0), mean(1), mean(2)};
}

// Maps each narrow block to the wider block that holds its middle.
template <class Real>
void MotionBounds<Real>::map_blocks(const Level& narrow, Level& wide) {
  for (int axis = 0; axis < 3; ++axis) {
    const CellGrid::Axis& from = narrow.grid.axis(axis);
    const CellGrid::Axis& to = wide.grid.axis(axis);
    auto& block_of = wide.block_of[static_cast<std::size_t>(axis)];
    block_of.assign(static_cast<std::size_t>(from.count) + 2, 0);
    for (std::int64_t i = 1; i <= from.count; ++i) {
      const auto at = static_cast<std::int64_t>((static_cast<double>(i) - 0.5) * from.cell / to.cell) + 1;
      block_of[static_cast<std::size_t>(i)] = static_cast<std::size_t>(std::min(at, to.count)) * stride_of(wide, axis);
    }
  }
}

// Finds the narrowest blocks that hold points of each window.
template <class Real>
void MotionBounds<Real>::find_blocks(const Vec3Columns<Real>& position_at_build, std::size_t count,
                                     std::size_t window) {
  const std::size_t windows = (count + window - 1) / window;
  std::vector<std::vector<std::uint32_t>> chunks((windows + kGrain - 1) / kGrain);
  first_block_.assign(windows + 1, 0);
  parallel_ranges(windows, kGrain, [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> keys(kGrain * window);
    for (std::size_t start = first; start < last; start += kGrain) {
      std::vector<std::uint32_t>& blocks = chunks[start / kGrain];
      const std::size_t end = std::min(start + kGrain, last);
      levels_[0].grid.keys_of(position_at_build, start * window, std::min(end * window, count), keys.data());
      for (std::size_t g = start; g < end; ++g) {
        const auto before = static_cast<std::ptrdiff_t>(blocks.size());
        for (std::size_t i = g * window; i < std::min((g + 1) * window, count); ++i) {
          const std::uint32_t block = keys[i - start * window];
          const bool same = static_cast<std::ptrdiff_t>(blocks.size()) > before && blocks.back() == block;
          if (!same && std::find(blocks.begin() + before, blocks.end(), block) == blocks.end()) blocks.push_back(block);
        }
        first_block_[g + 1] = static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(blocks.size()) - before);
      }
    }
  });
  for (std::size_t g = 0; g < windows; ++g) first_block_[g + 1] += first_block_[g];
  blocks_.clear();
  blocks_.reserve(first_block_.back());
  for (const auto& blocks : chunks) blocks_.insert(blocks_.end(), blocks.begin(), blocks.end());
}

template <class Real>
void MotionBounds<Real>::clear_motions() {
  motions_.assign(levels_[0].grid.key_end(), Motions{});
}

template <class Real>
void MotionBounds<Real>::add_motions(std::size_t first, std::span<const WindowMotion> motions) {
  std::array<Motions, kGrain> sums;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const WindowMotion& m = motions[k];
    sums[k].sum = {m.moved.x, m.moved.y, m.moved.z, m.step.x, m.step.y, m.step.z, m.count};
  }
  const std::lock_guard lock(mutex_);
  for (std::size_t k = 0; k < motions.size(); ++k) {
    for (const std::uint32_t block : blocks_of(first + k)) motions_[block].add(sums[k]);
  }
}

template <class Real>
std::int64_t MotionBounds<Real>::follow_motions(std::span<Frame> frames) {
  HOOKE_ASSERT(frames.size() >= window_count(), frames.size(), window_count());
  for (int axis = 0; axis < 3; ++axis) spread(levels_[0], std::span(motions_), axis);
  for (Level& level : levels_) level.boxes.assign(level.grid.key_end(), FrameRange{});
  place(frames);
  for (std::size_t l = 1; l < kLevels; ++l) bound_wider_blocks(levels_[l - 1], levels_[l]);
  anywhere_ = FrameRange{};
  for (const FrameRange& box : levels_.back().boxes) anywhere_.add(box);
  double steps = anywhere_.steps_within(levels_.back().apart);
  if (!(anywhere_.furthest() < 1000 * skin_)) steps = -1;  // rounding would take too much of the skin
  for (std::size_t l = 0; l < kLevels; ++l) {
    for (int axis = 0; axis < 3; ++axis) spread(levels_[l], std::span(levels_[l].boxes), axis);
    if (l == 0) continue;
    for (const FrameRange& box : levels_[l].boxes) steps = std::min(steps, box.steps_within(levels_[l - 1].apart));
  }
  allow(frames);
  return steps < 0 ? -1 : static_cast<std::int64_t>(std::min(steps, 1e6));
}

// Gives each window the mean motion around it, and each block the box around its windows' reference frames.
template <class Real>
void MotionBounds<Real>::place(std::span<Frame> frames) {
  parallel_ranges(window_count(), kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t g = first; g < last; ++g) {
      Motions around;
      for (const std::uint32_t block : blocks_of(g)) around.add(motions_[block]);
      const auto& s = around.sum;
      const Real scale = s[6] > Real(0) ? Real(1) / s[6] : Real(0);
      frames[g].offset = {scale * s[0], scale * s[1], scale * s[2]};
      frames[g].drift = {scale * s[3], scale * s[4], scale * s[5]};
    }
    const std::lock_guard lock(mutex_);
    for (std::size_t g = first; g < last; ++g) {
      for (const std::uint32_t block : blocks_of(g)) levels_[0].boxes[block].add(FrameRange::around(frames[g]));
    }
  });
}

template <class Real>
void MotionBounds<Real>::bound_wider_blocks(const Level& narrow, Level& wide) {
  for (std::size_t z = 1; z <= count_of(narrow, 2); ++z) {
    for (std::size_t y = 1; y <= count_of(narrow, 1); ++y) {
      const FrameRange* from = narrow.boxes.data() + z * stride_of(narrow, 2) + y * stride_of(narrow, 1);
      FrameRange* to = wide.boxes.data() + wide.block_of[2][z] + wide.block_of[1][y];
      for (std::size_t x = 1; x <= count_of(narrow, 0); ++x) to[wide.block_of[0][x]].add(from[x]);
    }
  }
}

// Each particle of a pair gets half of the part of the skin that neighbouring reference frames leave.
template <class Real>
void MotionBounds<Real>::allow(std::span<Frame> frames) const {
  parallel_ranges(window_count(), kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t g = first; g < last; ++g) {
      double apart = 0, growth = 0;
      for (const std::uint32_t block : blocks_of(g)) {
        apart = std::max(apart, levels_[0].boxes[block].across(0));
        growth = std::max(growth, levels_[0].boxes[block].across(3));
      }
      frames[g].buffer = static_cast<Real>((skin_ - apart) / 2);
      frames[g].buffer_loss = static_cast<Real>(growth / 2);
    }
  });
}

// Adds the contents of the two neighbours along the axis to each block.
template <class Real>
template <class T>
void MotionBounds<Real>::spread(const Level& level, std::span<T> blocks, int axis) {
  const std::size_t n = count_of(level, axis), stride = stride_of(level, axis);
  const int across = axis == 0 ? 1 : 0, up = axis == 2 ? 1 : 2;
  const std::size_t across_stride = stride_of(level, across), up_stride = stride_of(level, up);
  const bool periodic = level.grid.axis(axis).periodic;
  parallel_ranges(count_of(level, up), 1, [&](std::size_t first, std::size_t last) {
    constexpr std::size_t kSideBySide = 8;  // lines, adjacent in memory where they run along y or z
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

template class MotionBounds<float>;
template class MotionBounds<double>;

}  // namespace hooke
