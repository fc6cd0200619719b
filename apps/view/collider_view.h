// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "hooke/core/scene.h"
#include "hooke/render/shaded_mesh.h"

namespace hooke::view {

/// The surfaces of a scene's colliders, made once, and moved to where the colliders are.
class ColliderView {
 public:
  void set_scene(const Scene& scene);
  /// `poses`: one a collider. Relative to `origin`, m.
  std::vector<render::ShadedMesh> posed(std::span<const ColliderPose> poses, const Vec3d& origin) const;

 private:
  std::vector<render::ShadedMesh> meshes_;  // relative to the pivots, as written
};

}  // namespace hooke::view
