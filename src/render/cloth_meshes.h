// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/render/shaded_mesh.h"

namespace hooke {

/// The surfaces of the structure that a scene has, where its particles are, each in the colour of its first particle;
/// without the triangles that miss one or have a torn edge. `color_of` an index of a particle. Marks in `covered` (a
/// flag a particle) who is drawn.
std::vector<ShadedMesh> cloth_meshes(const Scene& scene, const ParticleSet& particles, const Vec3d& origin,
                                     const std::function<Color(std::size_t)>& color_of, std::vector<char>& covered);

}  // namespace hooke
