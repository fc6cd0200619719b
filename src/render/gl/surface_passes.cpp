// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/gl/surface_passes.h"

#include "hooke/base/assert.h"
#include "hooke/render/gl/sun.h"

namespace hooke {

namespace {

void restrict_to(const PixelRectangle& box) {
  constexpr int kAround = 4;  // pixels; blur.frag reads that far around
  glScissor(box.x - kAround, box.y - kAround, box.width + 2 * kAround, box.height + 2 * kAround);
}

}  // namespace

void SurfacePasses::run(const Frame& frame, const Projection& pixels, const PixelRectangle& box, float sphere_size,
                        bool water) const {
  HOOKE_ASSERT(sphere_size > 0, sphere_size);
  clear();
  glEnable(GL_SCISSOR_TEST);
  restrict_to(box);
  reduce();
  if (water) {
    smooth_water(pixels, sphere_size);
    find_water_normals(pixels, sphere_size);
  }
  restrict_to({box.x / 2, box.y / 2, RenderTargets::half(box.width), RenderTargets::half(box.height)});
  draw_ambient(frame, pixels, sphere_size);
  glDisable(GL_SCISSOR_TEST);
}

void SurfacePasses::clear() const {
  glClearColor(0, 0, 0, 0);
  for (const gl::Framebuffer& target : targets_.to_surface) {
    targets_.begin_pixels(target);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  glClearColor(1, 1, 1, 1);
  for (const gl::Framebuffer* target : {&targets_.to_ambient, &targets_.to_blurred}) {
    targets_.begin_ambient(*target);
    glClear(GL_COLOR_BUFFER_BIT);
  }
}

void SurfacePasses::reduce() const {
  const gl::Program& program = programs_.reduce;
  targets_.begin_pixels(targets_.to_surface[0]);
  program.use();
  program.read("depths", 0, targets_.depth);
  program.read("colors", 1, targets_.color);
  program.set("samples", samples_);
  whole_.draw();
}

void SurfacePasses::smooth_water(const Projection& pixels, float sphere_size) const {
  const gl::Program& program = programs_.smooth;
  program.use();
  program.set("range", 4.0f * sphere_size);
  program.set("scale", pixels.scale);
  // First a wide filter with few samples, then a narrow one that fills in between the samples.
  const float reaches[] = {4.0f, 1.5f};
  const int taps[] = {10, 6};
  for (std::size_t pass = 0; pass < 2; ++pass) {
    targets_.begin_pixels(targets_.to_surface[1 - pass]);
    program.read("surface", 0, targets_.surface[pass]);
    program.set("reach", reaches[pass] * sphere_size);
    program.set("taps", taps[pass]);
    whole_.draw();
  }
}

void SurfacePasses::find_water_normals(const Projection& pixels, float sphere_size) const {
  const gl::Program& program = programs_.water_normal;
  targets_.begin_pixels(targets_.to_water_normal);
  program.use();
  set_picture(program, pixels);
  program.read("surface", 0, targets_.surface[0]);
  program.set("range", 10.0f * sphere_size);
  whole_.draw();
}

void SurfacePasses::draw_ambient(const Frame& frame, const Projection& pixels, float sphere_size) const {
  const gl::Program& program = programs_.ambient;
  targets_.begin_ambient(targets_.to_ambient);
  program.use();
  set_picture(program, pixels);
  program.read("surface", 0, targets_.surface[0]);
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

}  // namespace hooke
