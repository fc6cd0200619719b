// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/core/sums.h"
#include "hooke/physics/attraction.h"

namespace hooke {

/// The attraction of a scene, spelled out: every pair, whatever method the scene asks for. Each particle's sum is by
/// ascending id of the others, in blocks of consecutive ids.
class ReferenceAttraction {
 public:
  void configure(const Scene& scene) {
    scene_ = scene;
    softening2_ = softening_squared(scene);
  }

  /// Forces on each particle, N, where there is attraction; else empty.
  std::vector<Vec3d> forces(const ParticleSet& p) const {
    std::vector<Vec3d> force(scene_.attraction ? p.size() : 0, Vec3d{0, 0, 0});
    for (std::size_t i = 0; i < force.size(); ++i) {
      Vec3d pull{0, 0, 0}, block{0, 0, 0};
      for (std::size_t k = 0; k < p.size(); ++k) {
        if (starts_block(p, k)) {
          pull += block;
          block = {0, 0, 0};
        }
        const Vec3d towards = p.position[k] - p.position[i];
        block += attraction<ExactMath>(towards, mass(p, k), softening2_) * towards;
      }
      force[i] = (mass(p, i) * scene_.attraction->constant) * (pull + block);
    }
    return force;
  }

  /// J, <= 0; each pair once.
  double energy(const ParticleSet& p) const {
    ExactSum energy;
    if (!scene_.attraction) return 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      double potential = 0, block = 0;
      for (std::size_t k = 0; k < p.size(); ++k) {
        if (starts_block(p, k)) {
          potential += block;
          block = 0;
        }
        const Vec3d towards = p.position[k] - p.position[i];
        if (dot(towards, towards) > 0) block += attraction_potential<ExactMath>(towards, mass(p, k), softening2_);
      }
      energy.add(0.5 * (mass(p, i) * scene_.attraction->constant) * (potential + block));
    }
    return energy.value();
  }

 private:
  static bool starts_block(const ParticleSet& p, std::size_t k) {
    return k > 0 && p.id[k] / kAttractionBlock != p.id[k - 1] / kAttractionBlock;
  }
  double mass(const ParticleSet& p, std::size_t i) const { return scene_.materials[p.material[i]].mass; }

  Scene scene_;
  double softening2_ = 0;
};

}  // namespace hooke
