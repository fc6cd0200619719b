// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hooke/base/vec3.h"
#include "hooke/core/scene.h"
#include "hooke/scene/json_reader.h"

namespace hooke {

/// Particles that keep each other together by the scene's attraction, as stars do: all bits follow from additions,
/// multiplications and square roots, so they are the same on every machine.
struct ClusterSource {
  enum class Profile {
    plummer,  ///< Plummer's sphere, isotropic velocities (Aarseth, Henon and Wielen 1974), cut off at ten scales
    disc,     ///< Kuzmin's disc, thin, on circles; cut off at six scales
  };
  Profile profile = Profile::plummer;
  Vec3d center{0, 0, 0};   ///< m
  double scale = 1;        ///< m, > 0: half of a sphere's particles are within 1.3 scales
  std::uint64_t count = 0;
  Vec3d normal{0, 1, 0};   ///< of a disc, about which it turns; not 0
  double companion = 0;    ///< kg, >= 0: mass of other clusters of the same centre and scale
  std::uint64_t seed = 1;
};

/// A source's "cluster" from its JSON, which has passed the schema and has its defaults.
ClusterSource read_cluster(const Json& json);

/// Its particles, each of `mass` (kg, > 0): positions, and velocities in equilibrium under `attraction`, softened not
/// at all; at rest where there is none.
struct ClusterParticles {
  std::vector<Vec3d> position;  ///< m
  std::vector<Vec3d> velocity;  ///< m/s
};
ClusterParticles make_cluster(const ClusterSource& cluster, double mass, const std::optional<Attraction>& attraction);

}  // namespace hooke
