// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "pile_statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hooke::test {
namespace {

// visit(i, p, overlap) for every touching pair, found by a sweep along z.
template <class Visit>
void for_each_touching_pair(const std::vector<Vec3d>& x, double radius, const Visit& visit) {
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return x[a].z < x[b].z; });
  for (std::size_t a = 0; a < order.size(); ++a) {
    for (std::size_t b = a + 1; b < order.size(); ++b) {
      const Vec3d d = x[order[b]] - x[order[a]];
      if (d.z >= 2 * radius) break;
      const double overlap = 2 * radius - std::sqrt(dot(d, d));
      if (overlap > 0) visit(order[a], order[b], overlap);
    }
  }
}

// Volume of a sphere's part below the plane at `height` above its centre.
double volume_below(double height, double radius) {
  const double h = std::clamp(height, -radius, radius) + radius;
  return M_PI * h * h * (radius - h / 3);
}

double volume_between(double z, double radius, double low, double high) {
  return volume_below(high - z, radius) - volume_below(low - z, radius);
}

}  // namespace

PileStatistics pile_statistics(const std::vector<Vec3d>& x, double radius, const Domain& box) {
  const auto n = static_cast<double>(x.size());
  PileStatistics s;
  std::vector<double> heights;
  for (const Vec3d& p : x) {
    heights.push_back(p.z);
    s.zcm += p.z / n;
  }
  std::sort(heights.begin(), heights.end());
  s.height_995 = heights[static_cast<std::size_t>(0.995 * n)];

  const double inset = 4 * radius;
  const auto in_bulk_columns = [&](const Vec3d& p) {
    return p.x > box.min.x + inset && p.x < box.max.x - inset && p.y > box.min.y + inset && p.y < box.max.y - inset;
  };
  const double low = inset, high = 0.8 * s.height_995, top = 0.9 * s.height_995;
  const double bulk = (box.length(0) - 2 * inset) * (box.length(1) - 2 * inset) * (high - low);
  const double overall = box.length(0) * box.length(1) * top;
  for (const Vec3d& p : x) {
    if (in_bulk_columns(p)) s.phi_bulk += volume_between(p.z, radius, low, high) / bulk;
    s.phi_overall += volume_between(p.z, radius, 0, top) / overall;
  }

  std::vector<int> contacts(x.size(), 0);
  std::vector<double> overlaps;
  for_each_touching_pair(x, radius, [&](std::size_t i, std::size_t p, double overlap) {
    ++contacts[i];
    ++contacts[p];
    overlaps.push_back(overlap / (2 * radius));
  });
  std::sort(overlaps.begin(), overlaps.end());
  const auto pairs = static_cast<double>(overlaps.size());
  s.mean_overlap_over_d = std::accumulate(overlaps.begin(), overlaps.end(), 0.0) / pairs;
  s.deep_overlap_over_d = overlaps[static_cast<std::size_t>(0.999 * pairs)];
  s.max_overlap_over_d = overlaps.back();
  double interior = 0, walls = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    int with_walls = contacts[i];
    for (int axis = 0; axis < 3; ++axis) {
      with_walls += component(x[i], axis) - component(box.min, axis) < radius ? 1 : 0;
      with_walls += component(box.max, axis) - component(x[i], axis) < radius ? 1 : 0;
    }
    s.z_all_pp += contacts[i] / n;
    walls += with_walls / n;
    s.rattlers += with_walls < 4 ? 1 / n : 0;
    if (in_bulk_columns(x[i]) && x[i].z > low && x[i].z < high) {
      ++interior;
      s.z_bulk += contacts[i];
    }
  }
  s.z_all_with_walls = walls;
  s.z_bulk /= interior;
  return s;
}

std::vector<SlabStatistics> pile_profile(const std::vector<Vec3d>& x, double radius, const std::vector<double>& edges) {
  std::vector<SlabStatistics> slabs(edges.size() - 1);
  const auto slab_of = [&](std::size_t i) -> SlabStatistics* {
    const auto after = std::upper_bound(edges.begin(), edges.end(), x[i].z);
    if (after == edges.begin() || after == edges.end()) return nullptr;
    return &slabs[static_cast<std::size_t>(after - edges.begin()) - 1];
  };
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (SlabStatistics* slab = slab_of(i)) ++slab->particles;
  }
  for_each_touching_pair(x, radius, [&](std::size_t i, std::size_t p, double overlap) {
    for (const std::size_t side : {i, p}) {
      SlabStatistics* slab = slab_of(side);
      if (slab == nullptr) continue;
      ++slab->contacts_each;
      slab->mean_overlap_over_d += overlap / (2 * radius);
    }
  });
  for (SlabStatistics& slab : slabs) {
    slab.mean_overlap_over_d /= std::max(1.0, slab.contacts_each);
    slab.contacts_each /= std::max(1.0, slab.particles);
  }
  return slabs;
}

}  // namespace hooke::test
