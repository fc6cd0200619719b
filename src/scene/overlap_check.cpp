// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/overlap_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "hooke/base/hash.h"
#include "hooke/core/contacts.h"
#include "hooke/scene/available_memory.h"

namespace hooke::scene {
namespace {

// A neighbour list holds a 4-byte number for each particle of a pair, and about as many pairs again that are near but
// do not overlap.
constexpr double kBytesPerPair = 16;

// 256 MB of them. Beyond that cells share counters, and the estimate is too high: then pairs are counted.
constexpr double kMostCounters = 1U << 26U;

double largest_radius(const Scene& scene, const ParticleSet& particles) {
  double radius = 0;
  for (const std::uint16_t m : particles.material) radius = std::max(radius, scene.materials[m].radius);
  return radius;
}

// Bytes; 0 where that is unknown.
double available_for_pairs(const LoadOptions& options) {
  return static_cast<double>(options.memory_limit != 0 ? options.memory_limit : available_memory());
}

// Bytes on this machine.
double needed_for_pairs(double pairs, const LoadOptions& options) { return kBytesPerPair * pairs * options.share_here; }

}  // namespace

PairEstimate::PairEstimate(double radius, double particles)
    : radius_(radius),
      count_(std::bit_ceil(static_cast<std::size_t>(std::clamp(particles, 1.0, kMostCounters)))) {}

void PairEstimate::add(std::span<const Vec3d> positions) {
  const auto cell = [radius = radius_](double x) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x / (2 * radius))));
  };
  for (const Vec3d& x : positions)
    ++count_[combine64(combine64(mix64(cell(x.x)), cell(x.y)), cell(x.z)) & (count_.size() - 1)];
}

double PairEstimate::most_pairs(std::uint64_t particles) {
  while (count_.size() > std::bit_ceil(std::max<std::uint64_t>(particles, 1))) {
    const std::size_t half = count_.size() / 2;
    for (std::size_t k = 0; k < half; ++k) count_[k] += count_[k + half];
    count_.resize(half);
  }
  double squares = 0;
  for (const std::uint32_t n : count_) squares += static_cast<double>(n) * n;
  return 0.5 * (4 * std::numbers::pi / 3) * squares;
}

bool has_room_for_pairs(double pairs, const LoadOptions& options) {
  const double available = available_for_pairs(options);
  return available == 0 || needed_for_pairs(pairs, options) <= available;
}

void refuse_overlaps(const Scene& scene, const ParticleSet& particles, const LoadOptions& options, Findings& findings) {
  if (particles.empty() || available_for_pairs(options) == 0) return;
  PairEstimate estimate(largest_radius(scene, particles), static_cast<double>(particles.size()));
  estimate.add(particles.position);
  if (has_room_for_pairs(estimate.most_pairs(particles.size()), options)) return;
  const double available = available_for_pairs(options);
  const Overlaps overlaps = count_overlaps(scene, particles);
  const double needed = needed_for_pairs(overlaps.pairs, options);
  if (needed <= available) return;
  findings.add("particles",
               fmt::format("overlap in about {:.3g} pairs, {:.3g} to a particle, whose list needs about {} of memory; "
                           "{} are available; particles {} and {} overlap most, by {:.3g} m, {:.3g} % of the sum of "
                           "their radii",
                           overlaps.pairs, 2 * overlaps.pairs / static_cast<double>(particles.size()), in_bytes(needed),
                           in_bytes(available), particles.id[overlaps.a], particles.id[overlaps.b], overlaps.overlap,
                           100 * overlaps.ratio));
}

}  // namespace hooke::scene
