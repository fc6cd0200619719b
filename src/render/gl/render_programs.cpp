// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/gl/render_programs.h"

#include <string>

#include "hooke/render/gl/shaders.h"

namespace hooke::render {

RenderPrograms::RenderPrograms() {
  using gl::Program;
  using namespace gl::shaders;
  const std::string view = view_glsl, lit = view + light_glsl;
  const auto picture = [](const std::string& fragment) { return Program(whole_picture_vert, fragment.c_str()); };
  sun = Program(spheres_vert, sun_depth_frag);
  sphere = Program(spheres_vert, spheres_frag);
  mesh = Program(meshes_vert, meshes_frag);
  mesh_sun = Program(meshes_vert, meshes_sun_depth_frag);
  reduce = picture(reduce_frag);
  outline = picture(outline_frag);
  smooth = picture(smooth_frag);
  water_normal = picture(view + water_normal_frag);
  ambient = picture(view + ambient_frag);
  blur = picture(blur_frag);
  backdrop = picture(lit + backdrop_frag);
  ball = picture(lit + shade_ball_frag);
  skin = picture(lit + shade_skin_frag);
  water = picture(lit + shade_water_frag);
  glass = Program(meshes_vert, (lit + glass_frag).c_str());
  spark = picture(view + shade_spark_frag);
  resolve = picture(view + resolve_frag);
  edge = Program(edges_vert, edges_frag);
}

void set_view(const gl::Program& program, const Projection& view) {
  program.set("eye", view.eye);
  program.set_rows("to_view", view.right, view.up, view.back);
}

void set_picture(const gl::Program& program, const Projection& view) {
  program.set("picture", view.width, view.height);
  program.set("scale", view.scale);
}

}  // namespace hooke::render
