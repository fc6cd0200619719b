// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "collider_view.h"

#include "hooke/base/assert.h"
#include "hooke/base/parallel.h"
#include "hooke/render/collider_mesh.h"

namespace hooke::view {

void ColliderView::set_scene(const Scene& scene) {
  Scene resting;
  resting.domain = scene.domain;
  resting.materials = scene.materials;
  meshes_.clear();
  for (const Collider& collider : scene.colliders) {
    resting.colliders.assign(1, collider);
    resting.colliders[0].motion = NoMotion{};
    for (render::ShadedMesh& mesh : render::collider_meshes(resting, 0, pivot_of(collider)))
      meshes_.push_back(std::move(mesh));
  }
}

std::vector<render::ShadedMesh> ColliderView::posed(std::span<const ColliderPose> poses, const Vec3d& origin) const {
  HOOKE_ASSERT(poses.size() == meshes_.size(), poses.size(), meshes_.size());
  std::vector<render::ShadedMesh> posed = meshes_;
  for (std::size_t k = 0; k < posed.size(); ++k) {
    const Vec3f shift = vec_cast<float>(poses[k].pivot - origin), x = vec_cast<float>(poses[k].turn[0]),
                y = vec_cast<float>(poses[k].turn[1]), z = vec_cast<float>(poses[k].turn[2]);
    std::vector<render::ShadedMesh::Corner>& corners = posed[k].corners;
    parallel_ranges(corners.size(), 4096, [&](std::size_t first, std::size_t last) {
      const auto turned = [&](const Vec3f& a) { return a.x * x + a.y * y + a.z * z; };
      for (std::size_t i = first; i < last; ++i) {
        corners[i].position = shift + turned(corners[i].position);
        corners[i].normal = turned(corners[i].normal);
      }
    });
  }
  return posed;
}

}  // namespace hooke::view
