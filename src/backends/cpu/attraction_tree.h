// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hooke/backends/cpu/attraction_pass.h"
#include "hooke/base/box3.h"
#include "hooke/base/huge_pages.h"

namespace hooke {

/// A particle that attracts and is attracted, in the scene's units of attraction.
template <class Real>
struct AttractionPoint {
  AttractionSource<Real> source;
  std::uint32_t id_index;   ///< unique, the order of ids
  std::uint32_t index;  ///< the caller's index of it
};

/// A binary tree over points. A node's box is halved across its longest side, but neither half gets less than an eighth
/// of the points: the tree follows the lumps of matter, and its depth is at most some times log N for any points.
/// Positions alone, and id indices where coordinates are equal, decide which node has which points.
template <class Real>
class AttractionTree {
 public:
  /// Leaves have at most two buckets of this many points. Each node's points start at the start of a bucket.
  static constexpr std::size_t kBucket = 8;
  static constexpr std::size_t kMostInLeaf = 2 * kBucket;
  /// Largest number of levels, for any number of points that fits 32 bits: log(2^32 / 8) / log(8 / 7).
  static constexpr std::size_t kMostLevels = 152;

  /// Lengths and masses in double, as single precision has no room for their powers.
  struct Node {
    double x, y, z;  ///< centre of mass
    double mass;
    double reach;  ///< no point is further from the centre of mass
    double spread;  ///< sum m r^2 around the centre of mass
    std::uint32_t first, last;  ///< points
    std::uint32_t child;  ///< the first of two consecutive children; 0 in leaves
  };
  /// Sorts `points`, fewer than 2^32, which must stay in place until the next build.
  void build(std::span<AttractionPoint<Real>> points);

  std::span<const AttractionPoint<Real>> points() const { return points_; }
  /// The root first, each level after the one above. Empty without points.
  std::span<const Node> nodes() const { return nodes_; }
  const Box3<Real>& box(std::size_t k) const { return boxes_[k]; }
  const AttractionCell<Real>& cell(std::size_t k) const { return cells_[k]; }
  /// The largest nodes of at most `most` points (>= kMostInLeaf). Each point is in exactly one of them.
  std::vector<std::uint32_t> largest_nodes(std::size_t most) const;

 private:
  void split_level(std::size_t first, std::size_t last);
  std::size_t split(std::size_t k);
  void sum_leaf(std::size_t k);
  void sum_children(std::size_t k);
  void finish_node(std::size_t k, const std::array<double, 6>& moments, double reach);

  std::span<AttractionPoint<Real>> points_;
  LargeVector<Node> nodes_;
  LargeVector<Box3<Real>> boxes_;
  LargeVector<AttractionCell<Real>> cells_;
  LargeVector<std::array<double, 6>> moments_;  // sum m r r^T around each centre of mass: xx, xy, xz, yy, yz, zz
};

extern template class AttractionTree<float>;
extern template class AttractionTree<double>;

}  // namespace hooke
