// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hooke::render::gl::shaders {

// The texts of the files of the same name in shaders/. RenderPrograms puts view.glsl and light.glsl before the
// fragment shaders that use them.
extern const char* const whole_picture_vert;
extern const char* const spheres_vert;
extern const char* const spheres_frag;
extern const char* const sun_depth_frag;
extern const char* const meshes_vert;
extern const char* const meshes_frag;
extern const char* const meshes_sun_depth_frag;
extern const char* const reduce_frag;
extern const char* const outline_frag;
extern const char* const smooth_frag;
extern const char* const view_glsl;
extern const char* const water_normal_frag;
extern const char* const ambient_frag;
extern const char* const blur_frag;
extern const char* const light_glsl;
extern const char* const backdrop_frag;
extern const char* const shade_ball_frag;
extern const char* const shade_spark_frag;
extern const char* const shade_skin_frag;
extern const char* const shade_water_frag;
extern const char* const glass_frag;
extern const char* const edges_vert;
extern const char* const edges_frag;
extern const char* const resolve_frag;
// LiveRenderer puts live_scene.glsl before the others.
extern const char* const live_scene_glsl;
extern const char* const live_balls_vert;
extern const char* const live_balls_frag;
extern const char* const live_points_vert;
extern const char* const live_points_frag;
extern const char* const live_meshes_vert;
extern const char* const live_meshes_frag;
extern const char* const live_lines_vert;
extern const char* const live_lines_frag;
extern const char* const live_final_frag;
extern const char* const live_footprint_glsl;
extern const char* const live_cover_comp;
extern const char* const live_cull_comp;

}  // namespace hooke::render::gl::shaders
