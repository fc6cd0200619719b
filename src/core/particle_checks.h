// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hooke/base/expected.h"
#include "hooke/base/vec3.h"
#include "hooke/core/particle_slices.h"
#include "hooke/core/particles.h"
#include "hooke/core/scene.h"

namespace hooke {

/// Findings of one kind are told up to so many: a set of a million bad particles makes its point sooner.
inline constexpr std::size_t kMostFindings = 20;

/// Whether all components are finite, and still are when rounded to float where `single` asks that.
bool is_finite(const Vec3d& a, bool single);

std::string shown(const Vec3d& a);  ///< "(1, 2, 3)"

/// Whether a place (m) is inside the domain, its faces included.
bool is_inside(const Domain& domain, const Vec3d& x);

/// What is wrong with one particle that is about to enter `scene` (m, m/s); empty where nothing is.
std::string particle_fault(const Scene& scene, std::size_t material, const Vec3d& x, const Vec3d& v);

/// What is wrong with a set of particles of `scene`; empty where nothing is. Those that are `restored` have
/// accelerations under velocity Verlet, and may stand outside of the domain.
std::vector<Finding> check_particles(const Scene& scene, const ParticleSet& particles, bool restored);

/// The same for particles in slices; an error where they can't be visited. `largest_id`: of all, 0 where there are
/// none.
Expected<std::vector<Finding>> check_particles(const Scene& scene, const ParticleSlices& particles, bool restored,
                                               std::uint64_t& largest_id);

}  // namespace hooke
