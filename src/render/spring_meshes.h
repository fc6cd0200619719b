// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "hooke/core/particles.h"
#include "hooke/core/scene.h"
#include "hooke/render/shaded_mesh.h"

namespace hooke::render {

/// The springs of a scene's structure as rods between its particles, a mesh a colour, as the scene's picture has them;
/// without springs that are broken, that cross a periodic face, or whose two ends are `covered` (a flag a particle) by
/// a surface. `color_of` takes the index of a particle. Strain colours from blue over white to red, up to the strain
/// that breaks a spring, or 10 %.
std::vector<ShadedMesh> spring_meshes(const Scene& scene, const ParticleSet& particles, const Vec3d& origin,
                                      const std::function<Color(std::size_t)>& color_of,
                                      const std::vector<char>& covered);

/// The colour of a strain over that which is coloured fully: -1 or less blue, 0 white, 1 or more red.
Color strain_color(double share);

}  // namespace hooke::render
