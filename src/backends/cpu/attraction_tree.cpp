// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/backends/cpu/attraction_tree.h"

#include <algorithm>
#include <cmath>

#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"

namespace hooke {
namespace {

template <class Real>
Real coordinate(const AttractionPoint<Real>& p, int axis) {
  return axis == 0 ? p.source.x : axis == 1 ? p.source.y : p.source.z;
}

template <class Real>
Box3<Real> box_around(std::span<const AttractionPoint<Real>> points) {
  Box3<Real> box = Box3<Real>::none();
  for (const AttractionPoint<Real>& p : points) box.add(Vec3<Real>{p.source.x, p.source.y, p.source.z});
  return box;
}

template <class Real>
int longest_axis(const Vec3<Real>& extent) {
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (component(extent, axis) > component(extent, longest)) longest = axis;
  }
  return longest;
}

// Adds m r r^T.
void add_spread(std::array<double, 6>& moments, double m, double x, double y, double z) {
  const double values[6] = {m * x * x, m * x * y, m * x * z, m * y * y, m * y * z, m * z * z};
  for (std::size_t k = 0; k < 6; ++k) moments[k] += values[k];
}

}  // namespace

template <class Real>
void AttractionTree<Real>::build(std::span<AttractionPoint<Real>> points) {
  HOOKE_ASSERT(points.size() < std::uint64_t{1} << 32U, points.size());
  points_ = points;
  nodes_.clear();
  boxes_.clear();
  if (points.empty()) return;
  nodes_.push_back({0, 0, 0, 0, 0, 0, 0, static_cast<std::uint32_t>(points.size()), 0});
  std::vector<std::size_t> levels{0, 1};  // where each starts
  while (levels.end()[-2] != levels.back()) {
    split_level(levels.end()[-2], levels.back());
    levels.push_back(nodes_.size());
  }
  cells_.resize(nodes_.size());
  moments_.resize(nodes_.size());
  for (std::size_t level = levels.size() - 1; level-- > 0;) {
    parallel_ranges(levels[level + 1] - levels[level], 64, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = levels[level] + first; k < levels[level] + last; ++k) {
        nodes_[k].child == 0 ? sum_leaf(k) : sum_children(k);
      }
    });
  }
}

// Splits the nodes of a level; their halves are the next level.
template <class Real>
void AttractionTree<Real>::split_level(std::size_t first, std::size_t last) {
  boxes_.resize(last);
  std::vector<std::size_t> middles(last - first);
  parallel_ranges(last - first, std::max<std::size_t>(1, (last - first) / 64), [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) middles[k] = split(first + k);
  });
  for (std::size_t k = first; k < last; ++k) {
    if (nodes_[k].last - nodes_[k].first <= kMostInLeaf) continue;
    const auto middle = static_cast<std::uint32_t>(middles[k - first]);
    nodes_[k].child = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({0, 0, 0, 0, 0, 0, nodes_[k].first, middle, 0});
    nodes_.push_back({0, 0, 0, 0, 0, 0, middle, nodes_[k].last, 0});
  }
}

// Sorts a node's points into its halves and returns where the second half starts. A leaf only gets its box.
template <class Real>
std::size_t AttractionTree<Real>::split(std::size_t k) {
  const std::size_t count = nodes_[k].last - nodes_[k].first;
  const auto own = points_.subspan(nodes_[k].first, count);
  const Box3<Real> box = boxes_[k] = box_around<Real>(own);
  if (count <= kMostInLeaf) return 0;
  const int axis = longest_axis(box.extent());
  const Real middle = Real(0.5) * (component(box.min, axis) + component(box.max, axis));
  const auto below = static_cast<std::size_t>(
      std::count_if(own.begin(), own.end(), [&](const auto& p) { return coordinate(p, axis) < middle; }));
  const std::size_t least = std::max<std::size_t>(1, count / (8 * kBucket));
  const std::size_t most = (count - 1) / kBucket - (least - 1);
  const std::size_t taken = std::clamp((below + kBucket / 2) / kBucket, least, most) * kBucket;
  std::nth_element(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(taken), own.end(),
                   [axis](const AttractionPoint<Real>& a, const AttractionPoint<Real>& b) {
                     const Real at_a = coordinate(a, axis), at_b = coordinate(b, axis);
                     return at_a != at_b ? at_a < at_b : a.id_index < b.id_index;
                   });
  return nodes_[k].first + taken;
}

template <class Real>
std::vector<std::uint32_t> AttractionTree<Real>::largest_nodes(std::size_t most) const {
  HOOKE_ASSERT(most >= kMostInLeaf, most);
  std::vector<std::uint32_t> found;
  const auto fits = [&](const Node& node) { return node.last - node.first <= most; };
  if (!nodes_.empty() && fits(nodes_[0])) found.push_back(0);
  for (const Node& node : nodes_) {
    if (fits(node)) continue;
    for (const std::uint32_t child : {node.child, node.child + 1}) {
      if (fits(nodes_[child])) found.push_back(child);
    }
  }
  return found;
}

template <class Real>
void AttractionTree<Real>::sum_leaf(std::size_t k) {
  Node& node = nodes_[k];
  const auto own = points_.subspan(node.first, node.last - node.first);
  std::sort(own.begin(), own.end(), [](const auto& a, const auto& b) { return a.id_index < b.id_index; });
  double x = 0, y = 0, z = 0;
  for (const auto& [p, id_index, index] : own) {
    const double m = p.mass;
    node.mass += m;
    x += m * p.x;
    y += m * p.y;
    z += m * p.z;
  }
  node.x = x / node.mass;
  node.y = y / node.mass;
  node.z = z / node.mass;
  std::array<double, 6> moments{};
  double reach2 = 0;
  for (const auto& [p, id_index, index] : own) {
    const double dx = p.x - node.x, dy = p.y - node.y, dz = p.z - node.z;
    add_spread(moments, p.mass, dx, dy, dz);
    reach2 = std::max(reach2, dx * dx + dy * dy + dz * dz);
  }
  finish_node(k, moments, std::sqrt(reach2));
}

template <class Real>
void AttractionTree<Real>::sum_children(std::size_t k) {
  Node& node = nodes_[k];
  const Node& a = nodes_[node.child];
  const Node& b = nodes_[node.child + 1];
  node.mass = a.mass + b.mass;
  node.x = (a.mass * a.x + b.mass * b.x) / node.mass;
  node.y = (a.mass * a.y + b.mass * b.y) / node.mass;
  node.z = (a.mass * a.z + b.mass * b.z) / node.mass;
  std::array<double, 6> moments{};
  double reach = 0;
  for (const std::uint32_t child : {node.child, node.child + 1}) {
    const Node& c = nodes_[child];
    const double dx = c.x - node.x, dy = c.y - node.y, dz = c.z - node.z;
    for (std::size_t m = 0; m < 6; ++m) moments[m] += moments_[child][m];
    add_spread(moments, c.mass, dx, dy, dz);
    reach = std::max(reach, std::sqrt(dx * dx + dy * dy + dz * dz) + c.reach);
  }
  // The box's furthest corner is usually nearer than that.
  const Vec3d centre{node.x, node.y, node.z};
  const Vec3d above = vec_cast<double>(boxes_[k].max) - centre, below = centre - vec_cast<double>(boxes_[k].min);
  double corner2 = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double off = std::max(component(above, axis), component(below, axis));
    corner2 += off * off;
  }
  finish_node(k, moments, std::min(reach, std::sqrt(corner2)));
}

template <class Real>
void AttractionTree<Real>::finish_node(std::size_t k, const std::array<double, 6>& moments, double reach) {
  Node& node = nodes_[k];
  node.reach = reach;
  node.spread = moments[0] + moments[3] + moments[5];
  moments_[k] = moments;
  const auto real = [](double value) { return static_cast<Real>(value); };
  cells_[k] = {real(node.x),
               real(node.y),
               real(node.z),
               {real(node.mass), real(3 * moments[0]), real(3 * moments[1]), real(3 * moments[2]), real(3 * moments[3]),
                real(3 * moments[4]), real(3 * moments[5]), real(1.5 * node.spread)}};
}

template class AttractionTree<float>;
template class AttractionTree<double>;

}  // namespace hooke
