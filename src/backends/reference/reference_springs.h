// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "hooke/base/ascending.h"
#include "hooke/base/assert.h"
#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/core/sums.h"
#include "hooke/physics/contact.h"
#include "hooke/physics/periodic.h"
#include "hooke/physics/spring.h"

namespace hooke {

/// The springs of a scene, spelled out: every spring by ascending index, so each particle adds up its springs in that
/// order.
class ReferenceSprings {
 public:
  void configure(const Scene& scene) {
    domain_ = scene.domain;
    structure_ = scene.structure;
    broken_.assign(springs().size(), false);
    exclusions_.clear();
    for (std::size_t s = 0; s < springs().size(); ++s) {
      if (springs().contact[s] == 0) exclusions_.push_back({pair_of(s), s});
    }
    std::sort(exclusions_.begin(), exclusions_.end());
  }

  /// Indices, ascending.
  void break_these(const std::vector<std::uint64_t>& broken) {
    HOOKE_ASSERT(is_ascending(broken), broken.size());
    HOOKE_ASSERT(broken.empty() || broken.back() < springs().size(), broken.back(), springs().size());
    broken_.assign(springs().size(), false);
    for (const std::uint64_t s : broken) broken_[s] = true;
  }
  std::vector<std::uint64_t> broken() const {
    std::vector<std::uint64_t> all;
    for (std::size_t s = 0; s < broken_.size(); ++s) {
      if (broken_[s]) all.push_back(s);
    }
    return all;
  }

  /// Forces on each particle, N, where there are springs; else empty.
  std::vector<Vec3d> forces(const ParticleSet& p, SpringSums& sums) const {
    std::vector<Vec3d> force(springs().empty() ? 0 : p.size(), Vec3d{0, 0, 0});
    for_each(p, [&](std::size_t s, std::size_t i, std::size_t j, const Vec3d& normal, double extension) {
      if (!spring_acts(extension, side(s))) return;
      const Vec3d w = p.velocity[j] - p.velocity[i];
      const SpringForce<double> f = spring_force(extension, normal, w, springs().stiffness[s], springs().damping[s]);
      force[i] += f.force;
      force[j] += -f.force;
      sums.dissipation.add(f.dissipation);
    });
    return force;
  }

  /// Returns the springs that tear at the present positions, and counts them; tear() breaks them.
  std::vector<std::size_t> torn(const ParticleSet& p, SpringSums& sums) const {
    std::vector<std::size_t> found;
    for_each(p, [&](std::size_t s, std::size_t, std::size_t, const Vec3d&, double extension) {
      if (!spring_tears(extension, springs().rest_length[s], springs().break_strain[s])) return;
      found.push_back(s);
      ++sums.broken;
      if (spring_acts(extension, side(s))) sums.broken_energy.add(spring_energy(extension, springs().stiffness[s]));
    });
    return found;
  }
  void tear(const std::vector<std::size_t>& these) {
    for (const std::size_t s : these) broken_[s] = true;
  }

  void measure(const ParticleSet& p, MeasurementSums& sums) const {
    ExactSum energy;
    const std::uint64_t count = add_energy(p, [](std::size_t, std::size_t) { return true; }, energy);
    sums.add_springs(count, energy);
  }

  /// Adds the energy of the springs between i and j, indices, for which among(i, j). Returns how many there are.
  template <class Among>
  std::uint64_t add_energy(const ParticleSet& p, const Among& among, ExactSum& energy) const {
    std::uint64_t count = 0;
    for_each(p, [&](std::size_t s, std::size_t i, std::size_t j, const Vec3d&, double extension) {
      if (!among(i, j)) return;
      ++count;
      if (spring_acts(extension, side(s))) energy.add(spring_energy(extension, springs().stiffness[s]));
    });
    return count;
  }

  /// Whether a spring keeps these two from touching.
  bool excludes(std::uint64_t a, std::uint64_t b) const {
    const auto pair = std::minmax(a, b);
    const auto found = std::lower_bound(exclusions_.begin(), exclusions_.end(), Apart{{pair.first, pair.second}, 0});
    for (auto k = found; k != exclusions_.end() && k->first == Pair{pair.first, pair.second}; ++k) {
      if (!broken_[k->second]) return true;
    }
    return false;
  }

  bool is_pinned(std::uint64_t id) const {
    return structure_ && std::binary_search(structure_->pinned.begin(), structure_->pinned.end(), id);
  }

 private:
  using Pair = std::pair<std::uint64_t, std::uint64_t>;
  using Apart = std::pair<Pair, std::size_t>;

  const SpringSet& springs() const {
    static const SpringSet none;
    return structure_ ? structure_->springs : none;
  }
  Pair pair_of(std::size_t s) const {
    return {std::min(springs().a[s], springs().b[s]), std::max(springs().a[s], springs().b[s])};
  }
  double side(std::size_t s) const {
    const SpringMode mode = springs().mode[s];
    return mode == SpringMode::compression ? -1 : mode == SpringMode::extension ? 1 : 0;
  }

  // visit(spring, i, j, normal from j to i, extension) for every unbroken spring whose two particles are there.
  template <class Visit>
  void for_each(const ParticleSet& p, Visit&& visit) const {
    for (std::size_t s = 0; s < springs().size(); ++s) {
      if (broken_[s]) continue;
      const std::size_t i = p.find(springs().a[s]), j = p.find(springs().b[s]);
      if (i == p.size() || j == p.size()) continue;
      const Vec3d x_ij = nearest_displacement(p.position[i], p.position[j], domain_.period());
      const double distance = sqrt_of(dot(x_ij, x_ij));
      visit(s, i, j, contact_normal(x_ij, distance, p.id[i] > p.id[j] ? 1.0 : -1.0),
            distance - springs().rest_length[s]);
    }
  }

  Domain domain_;
  std::shared_ptr<const Structure> structure_;
  std::vector<bool> broken_;  // by spring
  std::vector<Apart> exclusions_;  // pairs that don't touch, with their spring
};

}  // namespace hooke
