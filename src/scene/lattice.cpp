// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/lattice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hooke/base/assert.h"

namespace hooke::scene {
namespace {

constexpr double kMostSites = 9223372036854775808.0;  // 2^63

// Number of sites `distance` apart on a line of this length, the first at its start. A length that misses the next site
// by rounding (9.999999 spacings) still holds it.
std::uint64_t sites_on(double length, double distance) {
  constexpr double kRounding = 1e-5;
  if (length < -kRounding * distance) return 0;
  const double steps = std::floor(length / distance + kRounding);
  return steps >= kMostSites ? static_cast<std::uint64_t>(kMostSites) : static_cast<std::uint64_t>(steps) + 1;
}

double length(const Box3d& box, int axis) { return component(box.max, axis) - component(box.min, axis); }

// Of so many containers, those of even and of odd index with so many sites each: the index of the one that holds site
// `first`, or their number where none does. `first` becomes its index in there.
std::uint64_t find_site(std::uint64_t& first, std::uint64_t containers, const std::uint64_t (&sites)[2]) {
  std::uint64_t at = 0;
  const double both = static_cast<double>(sites[0]) + static_cast<double>(sites[1]);
  if (both == 0) return containers;
  if (both < kMostSites) {
    const std::uint64_t pairs = std::min(first / (sites[0] + sites[1]), containers / 2);
    at = 2 * pairs;
    first -= pairs * (sites[0] + sites[1]);
  }
  for (; at < containers && first >= sites[at % 2]; ++at) first -= sites[at % 2];
  return at;
}

// A product of counts, saturated at 2^63 as the counts are.
std::uint64_t saturated(double count) {
  return count >= kMostSites ? static_cast<std::uint64_t>(kMostSites) : static_cast<std::uint64_t>(count);
}

}  // namespace

UpDirection up_against(const Vec3d& gravity) {
  UpDirection up;
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double g = component(gravity, axis);
    if (std::abs(g) > largest) {
      largest = std::abs(g);
      up = {axis, g < 0};
    }
  }
  return up;
}

Lattice::Lattice(LatticeKind kind, const Box3d& box, double spacing, UpDirection up)
    : kind_(kind),
      box_(box),
      spacing_(spacing),
      up_(up),
      row_axis_((up.axis + 1) % 3),
      third_axis_((up.axis + 2) % 3) {
  HOOKE_ASSERT(spacing > 0, spacing);
  HOOKE_ASSERT(up.axis >= 0 && up.axis < 3, up.axis);
  // Hexagonal close packing: touching rows shifted by half a spacing, layers sqrt(2/3) spacings apart.
  const bool hcp = kind == LatticeKind::hcp;
  row_distance_ = hcp ? spacing * std::sqrt(3.0) / 2 : spacing;
  layer_distance_ = hcp ? spacing * std::sqrt(6.0) / 3 : spacing;
  layers_ = sites_on(length(box, up.axis), layer_distance_);
}

Lattice::Layer Lattice::layer(bool odd) const {
  const double half = spacing_ / 2;
  Layer found{};
  if (kind_ == LatticeKind::hcp) {
    // Every other layer (ABAB...) lies over the hollows of the layer below.
    found.row_offset = odd ? spacing_ * std::sqrt(3.0) / 6 : 0;
    found.site_offset[0] = odd ? half : 0;
    found.site_offset[1] = odd ? 0 : half;
  }
  found.rows = sites_on(length(box_, third_axis_) - found.row_offset, row_distance_);
  for (int parity = 0; parity < 2; ++parity) {
    found.sites[parity] = sites_on(length(box_, row_axis_) - found.site_offset[parity], spacing_);
  }
  return found;
}

std::uint64_t Lattice::sites_in(const Layer& l) const {
  const double even_rows = static_cast<double>(l.rows - l.rows / 2);
  const double odd_rows = static_cast<double>(l.rows / 2);
  const double many = even_rows * static_cast<double>(l.sites[0]) + odd_rows * static_cast<double>(l.sites[1]);
  return many < 1e15 ? (l.rows - l.rows / 2) * l.sites[0] + (l.rows / 2) * l.sites[1] : saturated(many);
}

std::uint64_t Lattice::site_count() const {
  const std::uint64_t even = sites_in(layer(false));
  const std::uint64_t odd = sites_in(layer(true));
  const double many = static_cast<double>(layers_) / 2 * (static_cast<double>(even) + static_cast<double>(odd));
  return many < 1e15 ? (layers_ - layers_ / 2) * even + (layers_ / 2) * odd : saturated(many);
}

void Lattice::append_sites(std::uint64_t first, std::uint64_t count, std::vector<Vec3d>& out) const {
  const Layer parities[2] = {layer(false), layer(true)};
  // The last site may lie beyond the box by the rounding tolerance; it is moved back to the face.
  const auto put = [this](Vec3d& site, int axis, double offset) {
    component(site, axis) = std::min(component(box_.min, axis) + offset, component(box_.max, axis));
  };
  for (std::uint64_t k = find_site(first, layers_, {sites_in(parities[0]), sites_in(parities[1])}); k < layers_; ++k) {
    const Layer& l = parities[k % 2];
    Vec3d site{0, 0, 0};
    const double height = static_cast<double>(k) * layer_distance_;
    if (up_.positive) {
      put(site, up_.axis, height);
    } else {
      component(site, up_.axis) = std::max(component(box_.max, up_.axis) - height, component(box_.min, up_.axis));
    }
    for (std::uint64_t j = find_site(first, l.rows, l.sites); j < l.rows; ++j) {
      put(site, third_axis_, l.row_offset + static_cast<double>(j) * row_distance_);
      for (std::uint64_t i = std::exchange(first, 0); i < l.sites[j % 2]; ++i) {
        if (count-- == 0) return;
        put(site, row_axis_, l.site_offset[j % 2] + static_cast<double>(i) * spacing_);
        out.push_back(site);
      }
    }
  }
}

}  // namespace hooke::scene
