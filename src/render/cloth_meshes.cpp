// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/cloth_meshes.h"

#include <algorithm>
#include <cmath>

#include "hooke/base/assert.h"
#include "hooke/core/torn_edges.h"

namespace hooke::render {

namespace {

Vec3d cross(const Vec3d& a, const Vec3d& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Whether an edge crosses a periodic face: its ends are neighbours in the domain, but far apart in a picture.
bool spans_domain(const Scene& scene, const Vec3d& edge) {
  for (int axis = 0; axis < 3; ++axis) {
    const bool periodic = scene.domain.boundary[static_cast<std::size_t>(axis)] == Boundary::periodic;
    if (periodic && std::abs(component(edge, axis)) > 0.5 * scene.domain.length(axis)) return true;
  }
  return false;
}

ShadedMesh make_mesh(const Surface& surface, const Scene& scene, const TornEdges& torn, const ParticleSet& particles,
                     const Vec3d& origin, const std::function<Color(std::size_t)>& color_of,
                     std::vector<char>& covered) {
  std::vector<std::size_t> index(surface.particles.size());
  for (std::size_t k = 0; k < index.size(); ++k) index[k] = particles.find(surface.particles[k]);
  const auto is_gone = [&](std::uint32_t corner) { return index[corner] == particles.size(); };

  std::vector<std::uint32_t> triangles;
  std::vector<Vec3d> normal(index.size(), Vec3d{0, 0, 0});
  for (std::size_t t = 0; t + 2 < surface.triangles.size(); t += 3) {
    const std::uint32_t* corner = surface.triangles.data() + t;
    if (std::any_of(corner, corner + 3, is_gone)) continue;
    if (torn.any_of({index[corner[0]], index[corner[1]], index[corner[2]]}, particles)) continue;
    const Vec3d& a = particles.position[index[corner[0]]];
    const Vec3d ab = particles.position[index[corner[1]]] - a, ac = particles.position[index[corner[2]]] - a;
    if (spans_domain(scene, ab) || spans_domain(scene, ac) || spans_domain(scene, ac - ab)) continue;
    triangles.insert(triangles.end(), corner, corner + 3);
    for (std::size_t k = 0; k < 3; ++k) normal[corner[k]] += cross(ab, ac);
  }
  ShadedMesh mesh;
  for (const std::uint32_t corner : triangles) {
    const std::size_t i = index[corner];
    const double length = std::sqrt(dot(normal[corner], normal[corner]));
    if (mesh.corners.empty()) {
      const Material& material = scene.materials[particles.material[i]];
      mesh.color = color_of(i);
      mesh.opacity = static_cast<float>(std::max(material.opacity, 1e-3));
      mesh.roughness = static_cast<float>(material.roughness);
    }
    covered[i] = 1;
    mesh.corners.push_back({vec_cast<float>(particles.position[i] - origin),
                            vec_cast<float>((length > 0 ? 1 / length : 0) * normal[corner])});
  }
  return mesh;
}

}  // namespace

std::vector<ShadedMesh> cloth_meshes(const Scene& scene, const ParticleSet& particles, const Vec3d& origin,
                                     const std::function<Color(std::size_t)>& color_of, std::vector<char>& covered) {
  HOOKE_ASSERT(scene.structure != nullptr);
  HOOKE_ASSERT(covered.size() == particles.size(), covered.size(), particles.size());
  std::vector<ShadedMesh> meshes;
  const TornEdges torn(scene);
  for (const Surface& surface : scene.structure->surfaces) {
    meshes.push_back(make_mesh(surface, scene, torn, particles, origin, color_of, covered));
  }
  return meshes;
}

}  // namespace hooke::render
