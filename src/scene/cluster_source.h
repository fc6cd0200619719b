// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hooke/base/vec3.h"
#include "hooke/core/scene.h"
#include "hooke/scene/json_reader.h"

namespace hooke::scene {

/// Particles held together by the scene's attraction, like stars. All bits follow from additions,
/// multiplications and square roots, so they are the same on every machine.
struct ClusterSource {
  enum class Profile {
    plummer,  ///< Plummer's sphere, isotropic velocities (Aarseth, Henon and Wielen 1974), cut off at ten scales
    disc,     ///< Kuzmin's thin disc, circular orbits; cut off at six scales
  };
  Profile profile = Profile::plummer;
  Vec3d center{0, 0, 0};   ///< m
  double scale = 1;        ///< m, > 0: half of a sphere's particles lie within 1.3 scales
  std::uint64_t count = 0;
  Vec3d normal{0, 1, 0};   ///< of a disc: its axis of rotation; not 0
  double companion = 0;    ///< kg, >= 0: mass of other clusters with the same centre and scale
  std::uint64_t seed = 1;
};

/// Reads a source's "cluster" from its JSON, which has passed the schema and has its defaults.
ClusterSource read_cluster(const Json& json);

/// The particles of a cluster, each of `mass` (kg, > 0): positions, and velocities in equilibrium under `attraction`
/// without softening. The particles are at rest where there is no attraction.
struct ClusterParticles {
  std::vector<Vec3d> position;  ///< m
  std::vector<Vec3d> velocity;  ///< m/s
};
ClusterParticles make_cluster(const ClusterSource& cluster, double mass, const std::optional<Attraction>& attraction);

}  // namespace hooke::scene
