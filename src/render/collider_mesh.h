// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "hooke/core/scene.h"
#include "hooke/render/shaded_mesh.h"

namespace hooke::render {

/// The surface of a shape as triangles; of a plane the part inside `domain`.
TriangleMesh shape_surface(const Shape& shape, const Domain& domain);

/// The colliders of a scene as they are drawn at `time` (s), relative to `origin` (m). Of a hollow collider that
/// encloses a space or is an open mesh, and is no glass, only the far side is drawn.
std::vector<ShadedMesh> collider_meshes(const Scene& scene, double time, const Vec3d& origin);

}  // namespace hooke::render
