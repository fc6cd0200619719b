// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/core/springs.h"
#include "hooke/physics/spring.h"

namespace hooke {

/// Where the surfaces of a scene's structure are torn: an edge is torn where the spring that ties its ends is stretched
/// so far that it is broken, or breaks in the next step. Only positions are needed, so this works for every snapshot.
/// Keeps a reference to the scene, which has a structure.
class TornEdges {
 public:
  explicit TornEdges(const Scene& scene) : scene_(scene) {
    HOOKE_ASSERT(scene.structure != nullptr);
    const SpringSet& springs = scene.structure->springs;
    for (std::size_t s = 0; s < springs.size(); ++s) {
      if (springs.break_strain[s] < std::numeric_limits<double>::infinity()) edges_.push_back(s);
    }
    std::sort(edges_.begin(), edges_.end(), [&](std::size_t s, std::size_t t) { return ends_of(s) < ends_of(t); });
  }

  /// Whether a triangle of these particles (indices into the set) has a torn edge.
  bool any_of(const std::size_t (&corners)[3], const ParticleSet& p) const {
    for (const std::size_t corner : corners) HOOKE_ASSERT(corner < p.size(), corner, p.size());
    return is_torn(corners[0], corners[1], p) || is_torn(corners[1], corners[2], p) ||
           is_torn(corners[2], corners[0], p);
  }

 private:
  struct Ends {
    std::uint64_t lower, upper;
    friend auto operator<=>(const Ends&, const Ends&) = default;
  };
  static Ends ends(std::uint64_t a, std::uint64_t b) { return {std::min(a, b), std::max(a, b)}; }
  Ends ends_of(std::size_t s) const {
    const SpringSet& springs = scene_.structure->springs;
    return ends(springs.a[s], springs.b[s]);
  }

  bool is_torn(std::size_t i, std::size_t k, const ParticleSet& p) const {
    const Ends edge = ends(p.id[i], p.id[k]);
    const auto found = std::lower_bound(edges_.begin(), edges_.end(), edge,
                                        [&](std::size_t s, const Ends& sought) { return ends_of(s) < sought; });
    if (found == edges_.end() || ends_of(*found) != edge) return false;
    const SpringSet& springs = scene_.structure->springs;
    const Vec3d off = nearest_displacement(p.position[i], p.position[k], scene_.domain.period());
    const double rest = springs.rest_length[*found];
    return spring_tears(std::sqrt(dot(off, off)) - rest, rest, springs.break_strain[*found]);
  }

  const Scene& scene_;
  std::vector<std::size_t> edges_;  // springs that can break, by their ends
};

}  // namespace hooke
