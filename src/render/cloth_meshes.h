// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/render/shaded_mesh.h"

namespace hooke::render {

/// The surfaces of the scene's structure, at the positions of its particles, each in the colour of its first particle;
/// without triangles that miss a particle or have a torn edge. `color_of` takes the index of a particle. Sets in
/// `covered` (a flag a particle) the flag of every particle that is a corner of a drawn triangle.
std::vector<ShadedMesh> cloth_meshes(const Scene& scene, const ParticleSet& particles, const Vec3d& origin,
                                     const std::function<Color(std::size_t)>& color_of, std::vector<char>& covered);

}  // namespace hooke::render
