// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/attraction_sums.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"

namespace hooke {
namespace {

// The targets are consecutive points. Copies of the last point fill up the last pack.
template <class Real>
void load_targets(std::span<const AttractionPoint<Real>> points, AttractionTargets<Real>& targets) {
  constexpr std::size_t kFilling = AttractionTargets<Real>::kFilling;
  targets.count = (points.size() + kFilling - 1) / kFilling * kFilling;
  for (std::size_t i = 0; i < targets.count; ++i) {
    const AttractionSource<Real>& p = points[std::min(i, points.size() - 1)].source;
    targets.x[i] = p.x;
    targets.y[i] = p.y;
    targets.z[i] = p.z;
    targets.ax[i] = targets.ay[i] = targets.az[i] = targets.potential[i] = 0;
  }
}

}  // namespace

// Direct ------------------------------------------------------------------------------------------------------------

template <class Real>
template <class Take>
void AttractionSums<Real>::sum_directly(std::span<AttractionPoint<Real>> points, std::size_t end, const IdTable& ids,
                                        typename AttractionLoops<Real>::Function by_particles, const Take& take) {
  constexpr std::size_t kMost = AttractionTargets<Real>::kMost;
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.id_index < b.id_index; });
  sources_.resize(points.size());
  std::vector<std::size_t> block_starts;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sources_[i] = points[i].source;
    const auto block = [&](std::size_t k) { return ids[points[k].id_index] / kAttractionBlock; };
    if (i == 0 || block(i) != block(i - 1)) block_starts.push_back(i);
  }
  block_starts.push_back(points.size());
  // The sources are copied: now those that are pulled come first, still in order.
  const auto is_pulled = [end](const AttractionPoint<Real>& p) { return p.index < end; };
  if (!std::all_of(points.begin(), points.end(), is_pulled)) {
    points = points.first(
        static_cast<std::size_t>(std::stable_partition(points.begin(), points.end(), is_pulled) - points.begin()));
  }
  parallel_ranges(points.size(), kMost, [&](std::size_t first, std::size_t last) {
    AttractionTargets<Real> targets;
    for (std::size_t from = first; from < last; from += kMost) {
      const std::span<const AttractionPoint<Real>> own = points.subspan(from, std::min(kMost, last - from));
      load_targets(own, targets);
      for (std::size_t b = 0; b + 1 < block_starts.size(); ++b) {
        AttractionWork<Real> work{&targets,
                                  sources_.data() + block_starts[b],
                                  block_starts[b + 1] - block_starts[b],
                                  nullptr,
                                  0,
                                  softening2_,
                                  attraction_.exact};
        by_particles(work);
      }
      for (std::size_t i = 0; i < own.size(); ++i) take(own[i].index, targets, i);
    }
  });
}

// Tree ---------------------------------------------------------------------------------------------------------------

namespace {

// The largest error of a node taken whole, as a fraction of the group's pull. The errors of many nodes go in all
// directions and most are far smaller, but a smaller limit means more nodes: the total error is as the 0.7th power of
// the limit. Measurements keep the requested accuracy, with a third to spare (tests/backends/attraction_test.cpp).
double allowed_for_node(double accuracy) { return 0.7 * accuracy * std::min(1.0, std::sqrt(1000 * accuracy)); }

// A group with hardly any pull, as in the middle of a cluster, gets the error limit of a group with this fraction of
// the mean pull.
constexpr double kFaint = 0.05;

// Room for the nodes still to visit: one more per level.
using Stack = std::array<std::uint32_t, AttractionTree<float>::kMostLevels + 2>;

// Square of the distance from a point to a box.
template <class Real>
double distance2(const Box3<Real>& box, const Vec3d& x) {
  const Vec3d below = vec_cast<double>(box.min) - x, above = x - vec_cast<double>(box.max);
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double off = std::max({component(below, axis), component(above, axis), 0.0});
    sum += off * off;
  }
  return sum;
}

}  // namespace

// The walk down the tree for one group, and what it finds.
template <class Real>
class AttractionSums<Real>::Walk {
 public:
  Walk(const AttractionTree<Real>& tree, const AttractionWork<Real>& work,
       typename AttractionLoops<Real>::Function by_particles, typename AttractionLoops<Real>::Function by_cells)
      : tree_(tree),
        work_(work),
        by_particles_(by_particles),
        by_cells_(by_cells) {
    work_.sources = sources_.data();
    work_.cells = cells_.data();
  }

  // Adds to the targets' sums. A node's error may be up to `allowed`, a mass over a length squared.
  void run(const Box3<Real>& box, double allowed) {
    const double allowed2 = allowed * allowed;
    Stack stack;
    std::size_t height = 0;
    stack[height++] = 0;
    while (height > 0) {
      const std::uint32_t k = stack[--height];
      const auto& node = tree_.nodes()[k];
      const double d2 = distance2(box, {node.x, node.y, node.z});
      if (is_far(node, d2, allowed2)) {
        add_cell(tree_.cell(k));
      } else if (node.child == 0) {
        add_leaf(node);
      } else {
        stack[height++] = node.child + 1;
        stack[height++] = node.child;
      }
    }
    flush_cells();
    flush_sources();
  }

 private:
  // The first term that a cell leaves out is an octupole, sum m r^3 / d^5 up to a factor.
  static bool is_far(const typename AttractionTree<Real>::Node& node, double d2, double allowed2) {
    if (!(node.reach * node.reach < d2)) return false;  // the expansion holds outside only
    const double octupole = node.spread * node.reach;
    return octupole * octupole <= allowed2 * (d2 * d2) * (d2 * d2) * d2;
  }

  void add_cell(const AttractionCell<Real>& cell) {
    if (work_.cell_count == cells_.size()) flush_cells();
    cells_[work_.cell_count++] = cell;
  }

  void add_leaf(const typename AttractionTree<Real>::Node& node) {
    for (std::size_t i = node.first; i < node.last; ++i) {
      if (work_.source_count == sources_.size()) flush_sources();
      sources_[work_.source_count++] = tree_.points()[i].source;
    }
  }

  void flush_cells() {
    by_cells_(work_);
    work_.cell_count = 0;
  }
  void flush_sources() {
    by_particles_(work_);
    work_.source_count = 0;
  }

  const AttractionTree<Real>& tree_;
  AttractionWork<Real> work_;
  typename AttractionLoops<Real>::Function by_particles_, by_cells_;
  std::array<AttractionSource<Real>, kAttractionBlock> sources_;
  std::array<AttractionCell<Real>, 256> cells_;
};

// A rough square of the pull at each group's centre of mass: nodes count as points even at a wide angle.
template <class Real>
std::vector<double> AttractionSums<Real>::estimate_pulls(std::span<const std::uint32_t> groups) const {
  std::vector<double> pulls2(groups.size());
  parallel_ranges(groups.size(), 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t g = first; g < last; ++g) {
      const auto& own = tree_.nodes()[groups[g]];
      Vec3d pull{0, 0, 0};
      Stack stack;
      std::size_t height = 0;
      stack[height++] = 0;
      while (height > 0) {
        const auto& node = tree_.nodes()[stack[--height]];
        const Vec3d towards{node.x - own.x, node.y - own.y, node.z - own.z};
        const double d2 = dot(towards, towards), reach2 = node.reach * node.reach;
        if (reach2 < d2 || node.child == 0) {
          const double softened2 = d2 + double(softening2_) + (reach2 < d2 ? 0 : reach2);
          pull += node.mass / (softened2 * std::sqrt(softened2)) * towards;
        } else {
          stack[height++] = node.child + 1;
          stack[height++] = node.child;
        }
      }
      pulls2[g] = dot(pull, pull);
    }
  });
  double mean = 0;
  for (const double pull2 : pulls2) mean += pull2 / static_cast<double>(groups.size());
  for (double& pull2 : pulls2) pull2 = std::max(pull2, kFaint * kFaint * mean);
  return pulls2;
}

template <class Real>
template <class Take>
void AttractionSums<Real>::sum_by_tree(std::span<AttractionPoint<Real>> points, std::size_t end,
                                       typename AttractionLoops<Real>::Function by_particles,
                                       typename AttractionLoops<Real>::Function by_cells, const Take& take) {
  tree_.build(points);
  const std::vector<std::uint32_t> groups = tree_.largest_nodes(AttractionTargets<Real>::kMost);
  const std::vector<double> pulls2 = estimate_pulls(groups);
  const double allowed = allowed_for_node(attraction_.accuracy);
  parallel_ranges(groups.size(), 4, [&](std::size_t first, std::size_t last) {
    AttractionTargets<Real> targets;
    Walk walk(tree_, {&targets, nullptr, 0, nullptr, 0, softening2_, attraction_.exact}, by_particles, by_cells);
    for (std::size_t g = first; g < last; ++g) {
      const auto& node = tree_.nodes()[groups[g]];
      const auto own = tree_.points().subspan(node.first, node.last - node.first);
      if (std::none_of(own.begin(), own.end(), [end](const auto& p) { return p.index < end; })) continue;
      load_targets(own, targets);
      walk.run(tree_.box(groups[g]), allowed * std::sqrt(pulls2[g]));
      for (std::size_t i = 0; i < own.size(); ++i) {
        if (own[i].index < end) take(own[i].index, targets, i);
      }
    }
  });
}

// Both ---------------------------------------------------------------------------------------------------------------

template <class Real>
void AttractionSums<Real>::configure(const Attraction& attraction, double softening2,
                                     const AttractionLoops<Real>& loops) {
  HOOKE_ASSERT(softening2 > 0, softening2);
  attraction_ = attraction;
  softening2_ = static_cast<Real>(softening2);
  loops_ = loops;
}

template <class Real>
void AttractionSums<Real>::accelerations(std::span<AttractionPoint<Real>> points, std::size_t end, const IdTable& ids,
                                         Vec3<Real>* a) {
  const auto take = [a](std::size_t index, const AttractionTargets<Real>& t, std::size_t i) {
    a[index] = {t.ax[i], t.ay[i], t.az[i]};
  };
  if (attracts_by_tree(attraction_, points.size())) {
    sum_by_tree(points, end, loops_.pull_by_particles, loops_.pull_by_cells, take);
  } else {
    sum_directly(points, end, ids, loops_.pull_by_particles, take);
  }
}

template <class Real>
void AttractionSums<Real>::potentials(std::span<AttractionPoint<Real>> points, std::size_t end, const IdTable& ids,
                                      double* potential) {
  const auto take = [potential](std::size_t index, const AttractionTargets<Real>& t, std::size_t i) {
    potential[index] = static_cast<double>(t.potential[i]);
  };
  if (attracts_by_tree(attraction_, points.size())) {
    sum_by_tree(points, end, loops_.potential_of_particles, loops_.potential_of_cells, take);
  } else {
    sum_directly(points, end, ids, loops_.potential_of_particles, take);
  }
}

template class AttractionSums<float>;
template class AttractionSums<double>;

}  // namespace hooke
