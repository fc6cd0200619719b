// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/core/attraction.h"

#include <algorithm>
#include <cmath>

#include "hooke/base/assert.h"
#include "hooke/base/format.h"
#include "hooke/core/scene.h"

namespace hooke {
namespace {

// n where 2^n is the power of two at or below `value` >= 0; 0 for 0.
int binary_order(double value) { return value > 0 ? std::ilogb(value) : 0; }

}  // namespace

std::vector<Finding> validate_attraction(const Scene& scene) {
  std::vector<Finding> findings;
  if (!scene.attraction) return findings;
  const Attraction& a = *scene.attraction;
  const auto not_negative = [&](const char* where, double value) {
    if (std::isfinite(value) && value >= 0) return;
    findings.push_back({where, formatted("{} must be a finite number, 0 or more", value)});
  };
  not_negative("attraction.G", a.constant);
  not_negative("attraction.softening", a.softening);
  if (!(a.accuracy >= kFinestAccuracy && a.accuracy <= kCoarsestAccuracy)) {
    findings.push_back(
        {"attraction.accuracy", formatted("{} must be from {} to {}", a.accuracy, kFinestAccuracy, kCoarsestAccuracy)});
  }
  for (const Boundary boundary : scene.domain.boundary) {
    if (boundary != Boundary::periodic) continue;
    findings.push_back({"attraction",
                        "is not to be had in a periodic domain, where every particle has images without "
                        "end; walls must be \"spring\" or \"open\""});
    break;
  }
  return findings;
}

bool attracts_by_tree(const Attraction& attraction, std::size_t particles) {
  HOOKE_ASSERT(attraction.accuracy >= kFinestAccuracy && attraction.accuracy <= kCoarsestAccuracy, attraction.accuracy);
  if (attraction.method != Attraction::Method::automatic) return attraction.method == Attraction::Method::tree;
  // Interactions per particle and step; one with a cell counts as two (bench/attraction_bench.cpp).
  const double n = static_cast<double>(particles);
  const double by_tree = 1500 * std::pow(1e-3 / attraction.accuracy, 0.5) + 100 * std::log2(std::max(n, 2.0));
  return by_tree < n;
}

AttractionUnits attraction_units(const Scene& scene) {
  AttractionUnits units;
  double longest = 0, largest_mass = 0;
  for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, scene.domain.length(axis));
  HOOKE_ASSERT(longest > 0, scene.domain.min, scene.domain.max);
  double smallest_radius = longest;
  for (const Material& m : scene.materials) {
    if (m.radius > 0) smallest_radius = std::min(smallest_radius, m.radius);
    largest_mass = std::max(largest_mass, m.mass);
  }
  units.length = std::ldexp(1.0, (binary_order(smallest_radius) + binary_order(longest)) / 2);
  units.mass = std::ldexp(1.0, binary_order(largest_mass));
  return units;
}

double softening_squared(const Scene& scene) {
  const double smallest = std::ldexp(attraction_units(scene).length, -40);
  const double softening = scene.attraction ? scene.attraction->softening : 0;
  return std::max(softening * softening, smallest * smallest);
}

}  // namespace hooke
