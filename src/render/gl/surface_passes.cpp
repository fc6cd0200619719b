// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/gl/surface_passes.h"

#include <algorithm>
#include <cmath>

#include "hooke/base/assert.h"
#include "hooke/render/gl/sun.h"

namespace hooke::render {

namespace {

void restrict_to(const PixelRectangle& box) {
  constexpr int kAround = 4;  // pixels; blur.frag reads that far around
  glScissor(box.x - kAround, box.y - kAround, box.width + 2 * kAround, box.height + 2 * kAround);
}

// Distance from the eye to the middle of the action less half its size, but at least a tenth of that, m.
float nearest_action(const Frame& frame) {
  const Vec3d to = frame.action.center() - frame.camera.eye;
  const float distance = static_cast<float>(std::sqrt(dot(to, to))), half = 0.5f * action_size(frame);
  return std::max(distance - half, 0.1f * half);
}

}  // namespace

void SurfacePasses::find_solids(const Frame& frame, const Projection& pixels, const PixelRectangle& box,
                                float sphere_size, bool ambient) const {
  HOOKE_ASSERT(sphere_size > 0, sphere_size);
  glClearColor(0, 0, 0, 0);
  targets_.begin_pixels(targets_.to_solids);
  glClear(GL_COLOR_BUFFER_BIT);
  if (ambient) clear_ambient();
  glEnable(GL_SCISSOR_TEST);
  restrict_to(box);
  reduce(targets_.to_solids, false);
  if (ambient) draw_ambient(frame, pixels, targets_.solids, box, sphere_size);
  glDisable(GL_SCISSOR_TEST);
}

void SurfacePasses::find_outline(Smooth what, const Projection& pixels, const PixelRectangle& box,
                                 float sphere_size) const {
  HOOKE_ASSERT(sphere_size > 0, sphere_size);
  const gl::Framebuffer& to_outline = targets_.to_outline[static_cast<std::size_t>(what)];
  glClearColor(0, 0, 0, 0);
  for (const gl::Framebuffer* target : {&targets_.to_surface[0], &to_outline}) {
    targets_.begin_pixels(*target);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  glEnable(GL_SCISSOR_TEST);
  restrict_to(box);
  reduce(targets_.to_surface[0], what == Smooth::water);
  const gl::Program& program = programs_.outline;
  targets_.begin_pixels(to_outline);
  program.use();
  program.read("surface", 0, targets_.surface[0]);
  program.set("bodies", what == Smooth::skin ? 1 : 0);
  program.set("reach", 1.8f * sphere_size);
  program.set("range", 10.0f * sphere_size);
  program.set("touching", 2.5f * sphere_size);
  program.set("inset", what == Smooth::skin ? 0.08f : 0.0f);
  program.set("scale", pixels.scale);
  whole_.draw();
  glDisable(GL_SCISSOR_TEST);
}

void SurfacePasses::smooth(Smooth what, const Frame& frame, const Projection& pixels, const PixelRectangle& box,
                           float sphere_size) const {
  HOOKE_ASSERT(sphere_size > 0, sphere_size);
  glClearColor(0, 0, 0, 0);
  for (const gl::Framebuffer& target : targets_.to_surface) {
    targets_.begin_pixels(target);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  clear_ambient();
  glEnable(GL_SCISSOR_TEST);
  restrict_to(box);
  reduce(targets_.to_surface[0], what == Smooth::water);
  smooth_depths(what, frame, pixels, sphere_size);
  find_normals(what, pixels, sphere_size);
  draw_ambient(frame, pixels, targets_.surface[0], box, sphere_size);
  glDisable(GL_SCISSOR_TEST);
}

void SurfacePasses::clear_ambient() const {
  glClearColor(1, 1, 1, 1);
  for (const gl::Framebuffer* target : {&targets_.to_ambient, &targets_.to_blurred}) {
    targets_.begin_ambient(*target);
    glClear(GL_COLOR_BUFFER_BIT);
  }
}

void SurfacePasses::reduce(const gl::Framebuffer& target, bool drops) const {
  const gl::Program& program = programs_.reduce;
  targets_.begin_pixels(target);
  program.use();
  program.read("depths", 0, targets_.depth);
  program.read("colors", 1, targets_.color);
  program.read("normals", 2, targets_.normal);
  program.set("drops", drops ? 1 : 0);
  program.set("samples", samples_);
  whole_.draw();
}

void SurfacePasses::smooth_depths(Smooth what, const Frame& frame, const Projection& pixels, float sphere_size) const {
  const gl::Program& program = programs_.smooth;
  program.use();
  program.set("bodies", what == Smooth::skin ? 1 : 0);
  program.set("range", 4.5f * sphere_size);
  program.set("rim", 0.6f * sphere_size);
  program.set("scale", pixels.scale);
  // Across and down; first a wide filter, whose steps between samples narrower ones then even out: the last one is of
  // use only where the steps of the one before are wider than a pixel.
  constexpr float kReaches[] = {4.0f, 4.0f, 1.8f, 1.8f, 0.6f, 0.6f};
  constexpr int kTaps[] = {8, 8, 6, 6, 8, 8};
  const float near_pixels = pixels.scale * sphere_size / nearest_action(frame);
  const int passes = kReaches[2] * near_pixels > static_cast<float>(kTaps[2]) ? 6 : 4;
  for (int pass = 0; pass < passes; ++pass) {
    const auto from = static_cast<std::size_t>(pass % 2);
    targets_.begin_pixels(targets_.to_surface[1 - from]);
    program.read("surface", 0, targets_.surface[from]);
    program.set("along", 1 - pass % 2, pass % 2);
    program.set("reach", kReaches[pass] * sphere_size);
    program.set("taps", kTaps[pass]);
    whole_.draw();
  }
}

void SurfacePasses::find_normals(Smooth what, const Projection& pixels, float sphere_size) const {
  const gl::Program& program = programs_.water_normal;
  targets_.begin_pixels(targets_.to_water_normal);
  program.use();
  program.set("bodies", what == Smooth::skin ? 1 : 0);
  set_picture(program, pixels);
  program.read("surface", 0, targets_.surface[0]);
  program.set("range", 4.0f * sphere_size);
  whole_.draw();
}

void SurfacePasses::draw_ambient(const Frame& frame, const Projection& pixels, const gl::Texture& surface,
                                 const PixelRectangle& box, float sphere_size) const {
  restrict_to({box.x / 2, box.y / 2, RenderTargets::half(box.width), RenderTargets::half(box.height)});
  const gl::Program& program = programs_.ambient;
  targets_.begin_ambient(targets_.to_ambient);
  program.use();
  set_picture(program, pixels);
  program.read("surface", 0, surface);
  program.read("normals", 1, targets_.normal);
  program.read("water_normals", 2, targets_.water_normal);
  program.set("samples", samples_);
  program.set("reach", 2.5f * sphere_size);
  program.set("far_reach", 0.08f * action_size(frame));
  whole_.draw();
  targets_.begin_ambient(targets_.to_blurred);
  programs_.blur.use();
  programs_.blur.read("ambient", 0, targets_.ambient[0]);
  whole_.draw();
}

}  // namespace hooke::render
