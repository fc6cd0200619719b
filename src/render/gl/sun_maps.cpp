// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/gl/sun_maps.h"

namespace hooke::render {

namespace {

void use(const gl::Program& program, const Sun& sun) {
  program.use();
  set_view(program, sun.projection);
  program.set("clip_scale", sun.scale(), sun.scale());
  program.set("parallel", 1);
  program.set("range", sun.range);
}

}  // namespace

void draw_sun_maps(const RenderTargets& targets, const RenderPrograms& programs, const Sun& sun,
                   const SeenSpheres& spheres, bool water, const MeshBuffer& buffer,
                   std::span<const ShadedMesh> meshes) {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glClearDepth(1);
  targets.begin_sun_map(targets.to_sun_map);
  glClear(GL_DEPTH_BUFFER_BIT);
  use(programs.sun, sun);
  spheres.of(SphereKind::ball).draw();
  spheres.of(SphereKind::skin).draw();
  use(programs.mesh_sun, sun);
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    // A mesh that is cut open for the eye, or of glass, lets the light in.
    const ShadedMesh& mesh = meshes[k];
    if (mesh.sides == ShadedMesh::Sides::both && !mesh.is_glass()) buffer.draw(k, MeshBuffer::Faces::all);
  }
  if (water) {
    targets.begin_sun_map(targets.to_water_sun_map);
    glClear(GL_DEPTH_BUFFER_BIT);
    use(programs.sun, sun);
    spheres.of(SphereKind::water).draw();
  }
  glDisable(GL_DEPTH_TEST);
}

}  // namespace hooke::render
