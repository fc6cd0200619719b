// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hooke/base/vec3.h"

namespace hooke {

struct Scene;

/// Particles on the host, one entry of every column per particle, in ascending order of id. Values that a
/// single-precision back end holds are exact in these doubles.
struct ParticleSet {
  std::vector<std::uint64_t> id;        ///< unique, ascending, never used again after a removal
  std::vector<std::uint16_t> material;  ///< index into Scene::materials
  std::vector<Vec3d> position;          ///< m
  std::vector<Vec3d> velocity;          ///< m/s; the full-step velocity
  std::vector<Vec3d> acceleration;      ///< m/s^2 of the last step: part of the state of velocity Verlet; else empty

  std::size_t size() const { return id.size(); }
  bool empty() const { return id.empty(); }
  void reserve(std::size_t n);
  void resize(std::size_t n);
  void clear();
  /// Whether all columns are of the same length; accelerations may be left out.
  bool columns_fit() const;

  /// Puts the columns, which fit, into ascending order of id (a stable permutation).
  void sort_by_id();
  /// Index of the particle of this id, or size() where there is none, in a set in ascending order. O(log n).
  std::size_t find(std::uint64_t particle_id) const;
};

/// The caller's columns, into which particles are copied in ascending order of id: one entry per particle, or null
/// where a column isn't wanted.
template <class Real>
struct ParticleColumns {
  std::uint64_t* id = nullptr;
  std::uint16_t* material = nullptr;
  Vec3<Real>* position = nullptr;      ///< m
  Vec3<Real>* velocity = nullptr;      ///< m/s
  Vec3<Real>* acceleration =
      nullptr;  ///< m/s^2 of the last step; left alone where the integrator is not velocity Verlet
};

/// Whether the columns fit, ids ascend, and materials are the scene's. All functions that take both a scene and its
/// particles rely on this.
bool are_particles_of(const ParticleSet& particles, const Scene& scene);

}  // namespace hooke
