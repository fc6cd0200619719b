// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "support/colliders.h"

#include <algorithm>
#include <string>

#include "hooke/volumes/openvdb_support.h"
#include "scene/made_meshes.h"

namespace hooke::test {
namespace {

#ifdef __SANITIZE_THREAD__
constexpr bool kHasMeshes = false;  // OpenVDB, in headers, is watched, and TBB, which orders what it does, is not
#else
constexpr bool kHasMeshes = true;
#endif

// A capsule of triangles, closed, or open at its top.
MeshShape mesh_around(const Vec3d& middle, double radius, bool closed, double reach) {
  TriangleMesh mesh = capsule_mesh(radius, -radius, radius, 16);
  if (!closed) mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 24);
  for (Vec3d& x : mesh.vertices) x += middle;
  return shape_of(mesh, 0.2 * radius, reach);
}

}  // namespace

void add_every_collider(Scene& scene, const Vec3d& middle, double size) {
  Material steel;
  steel.name = "steel";
  steel.radius = steel.mass = 0;
  steel.contact = {9000, 3, 5};
  scene.materials.push_back(steel);
  const auto at = [&](double x, double y, double z) { return middle + 0.5 * size * Vec3d{x, y, z}; };
  const double r = 0.12 * size;
  const Shape shapes[] = {PlaneShape{at(0, -0.9, 0), {0.1, 1, 0.05}},
                          BoxShape{at(-0.8, -0.9, -0.8), at(-0.4, -0.5, -0.2)},
                          SphereShape{at(0.5, -0.4, 0.5), r},
                          CapsuleShape{at(-0.6, 0, 0.2), at(-0.1, 0.2, 0.6), r},
                          CylinderShape{at(0.2, 0, -0.5), at(0.7, 0.1, -0.3), 1.4 * r},
                          DiscShape{at(0, 0.3, 0), {0.2, 1, 0}, 2 * r}};
  KeyframeMotion waved;
  waved.keyframes = {
      {0.01, {0, 0, 0}, {0, 0, 0}}, {0.04, {0.1 * size, 0, 0}, {0, 1, 0.3}}, {0.06, {0, 0, 0}, {1, 2, 0}}};
  const Motion motions[] = {NoMotion{}, SteadyMotion{{0.3, 0.1, 0}, {0, 2, 1}, middle}, waved,
                            Oscillation{{0, 0.05 * size, 0}, 3, 0.1}};
  std::size_t i = 0;
  for (const bool hollow : {false, true}) {
    for (const Shape& shape : shapes) {
      const bool plane = std::holds_alternative<PlaneShape>(shape);
      if (plane && hollow) continue;
      Collider c;
      c.name = "collider " + std::to_string(i);
      c.shape = shape;
      c.hollow = hollow;
      if (i % 3 == 1) c.material = scene.materials.size() - 1;
      c.motion = plane ? Motion(NoMotion{}) : motions[i % std::size(motions)];
      if (auto* steady = std::get_if<SteadyMotion>(&c.motion); steady != nullptr && i % 2 == 0) steady->pivot.reset();
      scene.colliders.push_back(c);
      ++i;
    }
  }
  double reach = 0;
  for (const Material& m : scene.materials) reach = std::max(reach, 1.1 * m.radius);
  for (const bool closed : {true, false}) {
    if (!kHasMeshes || !has_openvdb()) break;
    Collider c;
    c.name = closed ? "mesh" : "open mesh";
    c.shape = mesh_around(closed ? at(-0.5, -0.3, -0.6) : at(0.6, 0.6, -0.6), r, closed, reach);
    c.motion = closed ? Motion(Oscillation{{0, 0.05 * size, 0}, 3, 0.1})
                      : Motion(SteadyMotion{{0, 0, 0}, {0, 2, 1}, std::nullopt});
    scene.colliders.push_back(c);
  }
}

}  // namespace hooke::test
