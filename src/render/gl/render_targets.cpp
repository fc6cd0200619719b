// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/gl/render_targets.h"

#include <algorithm>

#include "hooke/render/gl/sun.h"

namespace hooke::render {

RenderTargets::RenderTargets(const RenderSettings& settings)
    : width(settings.width),
      height(settings.height),
      linear(settings.linear),
      samples_across(settings.width * settings.samples),
      samples_down(settings.height * settings.samples) {
  const auto per_sample = [this](GLenum format) {
    return gl::make_texture(samples_across, samples_down, format, GL_NEAREST);
  };
  const GLenum light = linear ? GL_RGBA16F : GL_RGBA8;
  color = per_sample(GL_RGBA8);
  normal = per_sample(GL_RGBA8);
  depth = per_sample(GL_R32F);
  depth_stencil = per_sample(GL_DEPTH32F_STENCIL8);
  shaded = per_sample(light);
  for (gl::Texture& s : surface) s = gl::make_texture(width, height, GL_RG32F, GL_NEAREST);
  for (gl::Texture& a : ambient) a = gl::make_texture(half(width), half(height), GL_R8, GL_LINEAR);
  water_normal = gl::make_texture(width, height, GL_RGBA16F, GL_NEAREST);
  for (gl::Texture& o : outline) o = gl::make_texture(width, height, GL_RGBA16F, GL_LINEAR);
  thickness = gl::make_texture(1, 1, GL_R32F, GL_LINEAR);
  backdrop = gl::make_texture(width, height, light, GL_NEAREST);
  behind = gl::make_texture(width, height, light, GL_LINEAR);
  solids = gl::make_texture(width, height, GL_RG32F, GL_NEAREST);
  water = gl::make_texture(width, height, light, GL_NEAREST);
  result = gl::make_texture(width, height, light, GL_NEAREST);
  for (gl::Texture* map : {&sun_map, &water_sun_map}) {
    *map = gl::make_texture(kSunMap, kSunMap, GL_DEPTH_COMPONENT32F, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  }

  to_sun_map = gl::make_framebuffer({}, &sun_map);
  to_water_sun_map = gl::make_framebuffer({}, &water_sun_map);
  to_spheres = gl::make_framebuffer({&color, &normal, &depth}, &depth_stencil);
  to_surface[0] = gl::make_framebuffer({&surface[0]}, nullptr);
  to_surface[1] = gl::make_framebuffer({&surface[1]}, nullptr);
  for (std::size_t k = 0; k < 2; ++k) to_outline[k] = gl::make_framebuffer({&outline[k]}, nullptr);
  to_water_normal = gl::make_framebuffer({&water_normal}, nullptr);
  to_ambient = gl::make_framebuffer({&ambient[0]}, nullptr);
  to_blurred = gl::make_framebuffer({&ambient[1]}, nullptr);
  to_backdrop = gl::make_framebuffer({&backdrop}, nullptr);
  to_shaded = gl::make_framebuffer({&shaded}, &depth_stencil);
  to_behind = gl::make_framebuffer({&behind}, nullptr);
  to_solids = gl::make_framebuffer({&solids}, nullptr);
  to_water = gl::make_framebuffer({&water}, nullptr);
  to_result = gl::make_framebuffer({&result}, nullptr);
}

void RenderTargets::copy(const gl::Framebuffer& from, const gl::Framebuffer& to) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from.get());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to.get());
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void RenderTargets::upload_thickness(const WaterThickness& of_water) const {
  glBindTexture(GL_TEXTURE_2D, thickness.get());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, of_water.columns, of_water.rows, 0, GL_RED, GL_FLOAT, of_water.meters.data());
}

namespace {

// Rows from the top, as images have them.
template <class Picture>
Picture read_pixels(int width, int height, GLenum type) {
  Picture flipped(width, height);
  glReadPixels(0, 0, width, height, GL_RGBA, type, flipped.pixels.data());
  const std::size_t row = Picture::kChannels * static_cast<std::size_t>(width);
  for (int y = 0; y < height / 2; ++y) {
    std::swap_ranges(flipped.at(0, y), flipped.at(0, y) + row, flipped.at(0, height - 1 - y));
  }
  return flipped;
}

}  // namespace

Image RenderTargets::read_result() const {
  begin_pixels(to_result);
  return read_pixels<Image>(width, height, GL_UNSIGNED_BYTE);
}

LinearImage RenderTargets::read_linear_result() const {
  begin_pixels(to_result);
  return read_pixels<LinearImage>(width, height, GL_FLOAT);
}

void RenderTargets::begin_sun_map(const gl::Framebuffer& target) const { begin(target, kSunMap, kSunMap); }

void RenderTargets::begin(const gl::Framebuffer& target, int across, int down) {
  glBindFramebuffer(GL_FRAMEBUFFER, target.get());
  glViewport(0, 0, across, down);
}

}  // namespace hooke::render
