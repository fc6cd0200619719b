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

// Estimates the number of overlapping pairs if every cell, as wide as the largest diameter, is filled evenly. The
// estimate may be too high, because cells share counters.
double most_pairs(const Scene& scene, const ParticleSet& particles) {
  double radius = 0;
  for (const std::uint16_t m : particles.material) radius = std::max(radius, scene.materials[m].radius);
  std::vector<std::uint32_t> count(std::bit_ceil(particles.size()));
  const auto cell = [radius](double x) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x / (2 * radius))));
  };
  for (const Vec3d& x : particles.position) {
    ++count[combine64(combine64(mix64(cell(x.x)), cell(x.y)), cell(x.z)) & (count.size() - 1)];
  }
  double squares = 0;
  for (const std::uint32_t n : count) squares += static_cast<double>(n) * n;
  return 0.5 * (4 * std::numbers::pi / 3) * squares;
}

}  // namespace

void refuse_overlaps(const Scene& scene, const ParticleSet& particles, const LoadOptions& options, Findings& findings) {
  if (particles.empty()) return;
  const std::uint64_t limit = options.memory_limit != 0 ? options.memory_limit : available_memory();
  const double available = static_cast<double>(limit);
  if (limit == 0 || kBytesPerPair * most_pairs(scene, particles) <= available) return;
  const Overlaps overlaps = count_overlaps(scene, particles);
  const double needed = kBytesPerPair * overlaps.pairs;
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
